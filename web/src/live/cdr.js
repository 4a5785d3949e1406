// Messages of ROS 2 as bytes (CDR, little endian), field after field.

const kText = new TextDecoder();

export class CdrReader {
  /** `bytes` is a DataView of a message, its head of four bytes included. */
  constructor(bytes) {
    this.bytes = new DataView(bytes.buffer, bytes.byteOffset + 4, bytes.byteLength - 4);
    this.at = 0;
  }

  place(size) {
    const begin = Math.ceil(this.at / size) * size;
    this.at = begin + size;
    return begin;
  }

  u8() {
    return this.bytes.getUint8(this.place(1));
  }

  u32() {
    return this.bytes.getUint32(this.place(4), true);
  }

  f64() {
    return this.bytes.getFloat64(this.place(8), true);
  }

  text() {
    const length = this.u32();
    const raw = this.raw(length);
    return kText.decode(raw.subarray(0, Math.max(0, length - 1)));
  }

  raw(length) {
    const raw = new Uint8Array(this.bytes.buffer, this.bytes.byteOffset + this.at, length);
    this.at += length;
    return raw;
  }

  list(read) {
    return Array.from({ length: this.u32() }, () => read(this));
  }

  header() {
    return { stamp: this.u32() + 1e-9 * this.u32(), frame: this.text() };
  }

  vector() {
    return [this.f64(), this.f64(), this.f64()];
  }

  pose() {
    return { position: this.vector(), orientation: [this.f64(), this.f64(), this.f64(), this.f64()] };
  }
}
