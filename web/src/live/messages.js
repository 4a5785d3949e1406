// The messages of a run, as the page wants them.
import { CdrReader } from "./cdr.js";

const kFloat32 = 7;

/** Coordinates of a cloud, x y z one after the other. */
function cloud(bytes) {
  const reader = new CdrReader(bytes);
  const { stamp, frame } = reader.header();
  const count = reader.u32() * reader.u32();
  const fields = reader.list(() => ({ name: reader.text(), offset: reader.u32(), type: reader.u8(), count: reader.u32() }));
  reader.u8(); // the order of bytes: ours
  const [stride] = [reader.u32(), reader.u32()];
  const length = reader.u32();
  const raw = reader.raw(length);
  const data = new DataView(raw.buffer, raw.byteOffset, length);
  const offsets = ["x", "y", "z"].map((name) => fields.find((f) => f.name === name && f.type === kFloat32).offset);
  const positions = new Float32Array(3 * count);
  for (let i = 0; i < count; ++i) {
    for (let axis = 0; axis < 3; ++axis) positions[3 * i + axis] = data.getFloat32(i * stride + offsets[axis], true);
  }
  return { stamp, frame, count, positions };
}

function odometry(bytes) {
  const reader = new CdrReader(bytes);
  const { stamp, frame } = reader.header();
  const body = reader.text();
  return { stamp, frame, body, ...reader.pose() };
}

function path(bytes) {
  const reader = new CdrReader(bytes);
  const { frame } = reader.header();
  return { frame, poses: reader.list(() => ({ ...reader.header(), ...reader.pose() })) };
}

function transforms(bytes) {
  const reader = new CdrReader(bytes);
  return {
    transforms: reader.list(() => {
      const { stamp, frame } = reader.header();
      return { stamp, frame, child: reader.text(), ...reader.pose() };
    }),
  };
}

function diagnostics(bytes) {
  const reader = new CdrReader(bytes);
  const { stamp } = reader.header();
  const [first] = reader.list(() => ({
    level: reader.u8(), name: reader.text(), message: reader.text(), hardware: reader.text(),
    values: Object.fromEntries(reader.list(() => [reader.text(), reader.text()])),
  }));
  return { stamp, ...first };
}

export const decoders = {
  "/map": cloud, "/scan": cloud, "/path": path, "/odometry": odometry, "/tf": transforms, "/diagnostics": diagnostics,
};
