// The colours of the map. Height in those of the paper: warm is low, cool is high.
import * as THREE from "three";

const kRamps = {
  height: ["#d7261e", "#f2711c", "#f7c31a", "#7cc242", "#1aa89a", "#2a6fc9", "#4b3fb0", "#7a35a8"],
  intensity: ["#2b1a52", "#6d2177", "#b5365f", "#ea6a3c", "#f8b04a", "#fbf3a0"],
  time: ["#3b2a78", "#30689a", "#2ba38b", "#8fcf4d", "#f6e05a"],
};

export const modes = ["height", "intensity", "time", "scan"];

export function gradient(mode) {
  if (mode === "scan") return "linear-gradient(90deg, #d55, #dd5, #5d5, #5dd, #55d, #d5d)";
  return `linear-gradient(90deg, ${kRamps[mode].join(", ")})`;
}

/** 256 colours as a texture. */
export function rampTexture(mode) {
  const stops = (kRamps[mode] ?? kRamps.height).map((c) => new THREE.Color().setStyle(c, THREE.LinearSRGBColorSpace));
  const data = new Uint8Array(4 * 256);
  for (let i = 0; i < 256; ++i) {
    const at = (i / 255) * (stops.length - 1);
    const low = Math.min(Math.floor(at), stops.length - 2);
    const c = stops[low].clone().lerp(stops[low + 1], at - low);
    data.set([255 * c.r, 255 * c.g, 255 * c.b, 255], 4 * i);
  }
  const texture = new THREE.DataTexture(data, 256, 1);
  texture.minFilter = texture.magFilter = THREE.LinearFilter;
  texture.needsUpdate = true;
  return texture;
}
