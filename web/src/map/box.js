// The boxes that the view is fitted to.
import * as THREE from "three";

const kInside = 0.99; // of the points lie in the box of the map: strays do not make it large

/** The box of all ways; one of two metres where there is none. */
export function boxOfWays(map) {
  const box = new THREE.Box3();
  for (const path of map.paths) {
    for (let i = 0; i < path.t.length; ++i) box.expandByPoint(new THREE.Vector3(path.x[i], path.y[i], path.z[i]));
  }
  return box.isEmpty() ? new THREE.Box3(new THREE.Vector3(-1, -1, 0), new THREE.Vector3(1, 1, 1)) : box;
}

/** The box of the ways and of nearly all points of the map. */
export function boxOfMap(map, points) {
  const box = boxOfWays(map);
  const p = points.sample;
  if (!p) return box;
  const stride = Math.max(1, Math.floor(p.count / 20000));
  const sides = [[], [], []];
  for (let i = 0; i < p.count; i += stride) [p.getX(i), p.getY(i), p.getZ(i)].forEach((v, axis) => sides[axis].push(v));
  const at = (values, share) => values[Math.floor(share * (values.length - 1))];
  sides.forEach((values) => values.sort((a, b) => a - b));
  const corner = (share) => new THREE.Vector3(...sides.map((v, a) => map.origin[a] + map.step * at(v, share)));
  return box.expandByPoint(corner((1 - kInside) / 2)).expandByPoint(corner((1 + kInside) / 2));
}
