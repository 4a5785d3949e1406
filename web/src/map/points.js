// The points of the map on the graphics card: two million 16-bit points, coloured and shown up to a
// moment by the shader, so that neither costs the page anything. They come in layers, each an even thinning of the whole
// and shuffled: so is any first part of them, which is what is drawn at first and while the view moves.
import * as THREE from "three";
import { inflated, undifferenced } from "../data.js";

const kVertex = `
attribute float intensity, scan, moment;
uniform float size, until, cut;
uniform vec2 heights;
uniform int mode;
uniform sampler2D ramp;
varying vec3 shade;
vec3 hue(float h) { return clamp(abs(mod(h * 6.0 + vec3(0.0, 4.0, 2.0), 6.0) - 3.0) - 1.0, 0.0, 1.0); }
void main() {
  vec4 at = modelViewMatrix * vec4(position, 1.0);
  gl_Position = moment > until || position.z > cut ? vec4(2.0, 2.0, 2.0, 1.0) : projectionMatrix * at;
  gl_PointSize = clamp(size / -at.z, 1.0, 12.0);
  float share = mode == 0 ? (position.z - heights.x) / (heights.y - heights.x) : mode == 1 ? intensity : moment;
  shade = mode == 4 ? vec3(0.86, 0.15, 0.22) : mode == 3 ? mix(vec3(0.55), hue(fract(scan * 0.6180339887)), 0.75)
                    : texture2D(ramp, vec2(clamp(share, 0.002, 0.998), 0.5)).rgb;
}`;
const kFragment = `
varying vec3 shade;
void main() { gl_FragColor = vec4(shade, 1.0); }`;
const kHeightShares = [0.005, 0.995]; // of the points, whose heights end the ramp

function greatestDivisor(a, b) {
  return b === 0 ? a : greatestDivisor(b, a % b);
}

/** Places of a shuffle of `count` things. */
function shuffled(count) {
  let stride = Math.max(1, Math.round(count * 0.6180339887));
  while (greatestDivisor(stride, count) !== 1) ++stride;
  const places = new Uint32Array(count);
  for (let i = 0, at = 0; i < count; ++i, at = (at + stride) % count) places[at] = i;
  return places;
}

function heightRange(z) {
  const step = Math.max(1, Math.floor(z.length / 20000));
  const sample = z.filter((_, i) => i % step === 0).sort();
  const [low, high] = kHeightShares.map((share) => sample[Math.floor(share * (sample.length - 1))]);
  return high > low ? [low, high] : [low, low + 1];
}

/** The number of a scan as a moment of the run, 0 to 1, by the stamps of the poses. */
function momentsOf(times, scansPerNumber) {
  const last = times[times.length - 1] || 1;
  return (scan) => times[Math.min(scan * scansPerNumber, times.length - 1)] / last;
}

/** The points of a layer of the map, as the graphics card takes them. */
export async function unpacked(map, layer) {
  const { count } = layer;
  const [x, y, z, scan, intensity] = await Promise.all([
    undifferenced(layer.x, count), undifferenced(layer.y, count), undifferenced(layer.z, count), undifferenced(layer.scan, count), inflated(layer.intensity),
  ]);
  const position = new Uint16Array(4 * count); // the fourth number fills up eight bytes a point
  const ordered = { position, scan: new Uint16Array(count), moment: new Uint16Array(count), intensity: new Uint8Array(count) };
  const momentOf = momentsOf(map.paths[0].t, map.scans_per_number);
  const places = shuffled(count);
  for (let i = 0; i < count; ++i) {
    const to = places[i];
    position[4 * to] = x[i];
    position[4 * to + 1] = y[i];
    position[4 * to + 2] = z[i];
    ordered.scan[to] = scan[i];
    ordered.moment[to] = Math.round(65535 * momentOf(scan[i]));
    ordered.intensity[to] = intensity[i];
  }
  return { ...ordered, count, heights: heightRange(z) };
}

function geometryOf({ position, scan, moment, intensity }) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.InterleavedBufferAttribute(new THREE.InterleavedBuffer(position, 4), 3, 0));
  geometry.setAttribute("scan", new THREE.BufferAttribute(scan, 1));
  geometry.setAttribute("moment", new THREE.BufferAttribute(moment, 1, true));
  geometry.setAttribute("intensity", new THREE.BufferAttribute(intensity, 1, true));
  return geometry;
}

export class MapPoints {
  /** `first` is the first layer, unpacked; nothing where the map has no points. */
  constructor(map, first) {
    const heights = first?.heights ?? [0, 1];
    const uniforms = { size: { value: 1 }, until: { value: 2 }, cut: { value: 65536 }, heights: { value: heights }, mode: { value: 0 }, ramp: { value: null } };
    this.material = new THREE.ShaderMaterial({ vertexShader: kVertex, fragmentShader: kFragment, uniforms });
    this.object = new THREE.Group();
    this.object.scale.setScalar(map.step);
    this.object.position.fromArray(map.origin);
    this.numberOf = (height) => (height - map.origin[2]) / map.step;
    this.heights = heights.map((h) => map.origin[2] + h * map.step); // [m] at the ends of the ramp
    this.layers = [];
    this.count = 0; // of the layers that are there
    if (first) this.add(first);
  }

  /** Adds an unpacked layer. */
  add(layer) {
    const cloud = new THREE.Points(geometryOf(layer), this.material);
    cloud.frustumCulled = false;
    this.object.add(cloud);
    this.layers.push({ cloud, begin: this.count, end: this.count + layer.count });
    this.count += layer.count;
  }

  /** Coordinates of an even thinning, as whole numbers. */
  get sample() {
    return this.layers[0]?.cloud.geometry.attributes.position;
  }

  colorBy(mode, ramp) {
    this.material.uniforms.mode.value = mode;
    this.material.uniforms.ramp.value = ramp;
  }

  /** One colour for all: of what moved. */
  inRed() {
    this.material.uniforms.mode.value = 4;
  }

  /** Shows what was seen until `share` of the run, 0 to 1. */
  showUntil(share) {
    this.material.uniforms.until.value = share >= 1 ? 2 : share;
  }

  /** Hides what lies above `height` [m]. */
  cutAbove(height) {
    this.material.uniforms.cut.value = this.numberOf(height);
  }

  /** [px] of a point seen from 1 m. */
  setSize(pixels) {
    this.material.uniforms.size.value = pixels;
  }

  /** Draws `count` points from number `first` on. */
  draw(first, count) {
    for (const { cloud, begin, end } of this.layers) {
      const [from, to] = [Math.max(first, begin), Math.min(first + count, end)];
      cloud.visible = to > from;
      if (cloud.visible) cloud.geometry.setDrawRange(from - begin, to - from);
    }
  }
}
