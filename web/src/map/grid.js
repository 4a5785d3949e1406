// The scaled grid that the map stands over: lines every 1, 2 or 5 times a power of ten metres, with their metres.
import * as THREE from "three";

const kLines = 12; // about so many along the longer side
const kLabelHeight = 0.034; // of the view

export function gridStep(length) {
  const raw = length / kLines;
  const power = 10 ** Math.floor(Math.log10(raw));
  return power * ([1, 2, 5].find((f) => f * power >= raw) ?? 10);
}

function label(text, color) {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [160, 48];
  const brush = canvas.getContext("2d");
  brush.font = "30px system-ui, sans-serif";
  brush.textAlign = "center";
  brush.textBaseline = "middle";
  brush.fillStyle = color;
  brush.fillText(text, 80, 24);
  const material = new THREE.SpriteMaterial({ map: new THREE.CanvasTexture(canvas), sizeAttenuation: false, depthWrite: false });
  const sprite = new THREE.Sprite(material);
  sprite.scale.set((kLabelHeight * 160) / 48, kLabelHeight, 1);
  return sprite;
}

/** `box` grown to whole steps of its grid. */
export function gridBox(box) {
  const size = box.getSize(new THREE.Vector3());
  const step = gridStep(Math.max(size.x, size.y, 1));
  const out = (value, round) => round(value / step) * step;
  const [low, high] = [box.min, box.max];
  return new THREE.Box3(
    new THREE.Vector3(out(low.x, Math.floor), out(low.y, Math.floor), low.z),
    new THREE.Vector3(out(high.x, Math.ceil), out(high.y, Math.ceil), high.z),
  );
}

/** Grid over `box` at its lower side, in `lineColor`; its labels in `textColor`. */
export function makeGrid(box, lineColor, textColor) {
  const size = box.getSize(new THREE.Vector3());
  const step = gridStep(Math.max(size.x, size.y, 1));
  const { min, max } = gridBox(box);
  const [x0, x1, y0, y1, z] = [min.x, max.x, min.y, max.y, min.z];
  const group = new THREE.Group();
  const [ends, labels] = [[], []];
  for (let x = x0; x <= x1 + step / 2; x += step) {
    ends.push(x, y0, z, x, y1, z);
    labels.push([x, x + 2 * step > x1 + step / 2, x, y0 - 0.5 * step]);
  }
  for (let y = y0; y <= y1 + step / 2; y += step) {
    ends.push(x0, y, z, x1, y, z);
    labels.push([y, y + 2 * step > y1 + step / 2, x0 - 0.5 * step, y]);
  }
  for (const [value, last, x, y] of labels) {
    if (Math.round(value / step) % 2 !== 0) continue; // every other line
    const sprite = label(`${Math.round(value * 1000) / 1000}${last ? " m" : ""}`.replace("-", "−"), textColor);
    sprite.position.set(x, y, z);
    group.add(sprite);
  }
  const geometry = new THREE.BufferGeometry().setAttribute("position", new THREE.Float32BufferAttribute(ends, 3));
  group.add(new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ color: lineColor })));
  return group;
}
