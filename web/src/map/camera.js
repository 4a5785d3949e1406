// Where the camera stands.
import * as THREE from "three";

export const kFieldOfView = 45; // [deg]
const kRoom = 1.16; // times the distance from which all is seen: the numbers at the grid need it

/** Puts `camera` so that it looks along `direction` reversed and `box` fills the view; returns where it looks to. */
export function frame(camera, box, direction) {
  const target = box.getCenter(new THREE.Vector3());
  const tangent = Math.tan((kFieldOfView * Math.PI) / 360);
  let distance = 2 * box.getSize(new THREE.Vector3()).length();
  for (let i = 0; i < 8; ++i) {
    camera.position.copy(target).addScaledVector(direction, distance);
    camera.lookAt(target);
    camera.updateMatrixWorld();
    const seen = new THREE.Box3();
    for (let corner = 0; corner < 8; ++corner) {
      const at = ["x", "y", "z"].map((axis, k) => (corner & (1 << k) ? box.max : box.min)[axis]);
      seen.expandByPoint(new THREE.Vector3(...at).project(camera));
    }
    const middle = seen.getCenter(new THREE.Vector3());
    const half = seen.getSize(new THREE.Vector3()).multiplyScalar(0.5);
    const shift = new THREE.Vector3(middle.x * camera.aspect, middle.y, 0).multiplyScalar(tangent * distance);
    target.add(shift.applyQuaternion(camera.quaternion));
    distance *= kRoom * Math.max(half.x, half.y);
  }
  camera.position.copy(target).addScaledVector(direction, distance);
  return target;
}
