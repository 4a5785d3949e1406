// What the page holds, as arrays of numbers. docs/report.md describes the JSON.

export function bytesOf(base64) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(base64);
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

export function floatsOf(base64) {
  return new Float32Array(bytesOf(base64).buffer);
}

/** The content of a zlib stream in base64. */
export async function inflated(base64) {
  const stream = new Blob([bytesOf(base64)]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Undoes the packing of tilth/report/packed_map.hpp: zigzag differences, low bytes before high bytes. */
export async function undifferenced(base64, count) {
  const bytes = await inflated(base64);
  const values = new Uint16Array(count);
  let value = 0;
  for (let i = 0; i < count; ++i) {
    const zigzag = bytes[i] | (bytes[count + i] << 8);
    value = (value + ((zigzag >>> 1) ^ -(zigzag & 1))) & 0xffff;
    values[i] = value;
  }
  return values;
}

/** The JSON of the page, its array numbers replaced by the arrays. */
export function readReport() {
  const report = JSON.parse(document.getElementById("report").textContent);
  const decoded = new Map();
  const array = (number) => {
    if (number === undefined) return undefined;
    if (!decoded.has(number)) decoded.set(number, floatsOf(report.arrays[number]));
    return decoded.get(number);
  };
  for (const plot of Object.values(report.plots)) {
    for (const curve of plot.curves) {
      for (const key of ["x", "y", "shade"]) lazily(curve, key, array);
    }
    for (const places of [plot.links, plot.dots]) {
      for (const key of places ? ["x", "y"] : []) lazily(places, key, array);
    }
  }
  for (const path of report.map?.paths ?? []) {
    for (const key of ["t", "x", "y", "z", "qx", "qy", "qz", "qw"]) path[key] = array(path[key]);
  }
  return report;
}

function lazily(object, key, array) {
  const number = object[key];
  Object.defineProperty(object, key, { get: () => array(number), enumerable: true });
}

/** Index of the last of the ascending `values` that is not above `value`; 0 where all are. */
export function lastNotAbove(values, value) {
  let low = 0;
  let high = values.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (values[middle] <= value) low = middle;
    else high = middle - 1;
  }
  return low;
}
