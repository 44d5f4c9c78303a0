// SPDX-License-Identifier: Apache-2.0
// Estimates the camera of a photo: the camera for which the projections of some points differ least from the points in
// the photo, up to scale, translation and roll of the photo.
import { Matrix4, Vector3 } from 'three';

const away = [2.5, 3.5, 5, 7, 10, 14]; // distances to try; they differ in perspective
const enough = 6; // number of points from which the distance is estimated, too

/// The least-squares similarity z ↦ (a + ib) z + (x + iy) between two lists of points, and its residual.
function similarityOf(from, to) {
  const mean = (points) => [0, 1].map((c) => points.reduce((sum, point) => sum + point[c], 0) / points.length);
  const [p, q] = [mean(from), mean(to)];
  let [spread, real, imaginary, all] = [0, 0, 0, 0];
  from.forEach((point, i) => {
    const [x, y] = [point[0] - p[0], point[1] - p[1]];
    const [u, v] = [to[i][0] - q[0], to[i][1] - q[1]];
    spread += x * x + y * y;
    real += x * u + y * v;
    imaginary += x * v - y * u;
    all += u * u + v * v;
  });
  const [a, b] = [real / spread, imaginary / spread];
  const left = Math.max(0, all - (real * real + imaginary * imaginary) / spread);
  return { similarity: [a, b, q[0] - a * p[0] + b * p[1], q[1] - b * p[0] - a * p[1]], left, share: left / all };
}

function positionOf([yaw, pitch, distance], target) {
  return new Vector3(Math.sin(yaw) * Math.cos(pitch), Math.sin(pitch), Math.cos(yaw) * Math.cos(pitch))
    .multiplyScalar(distance).add(target);
}

/// \param points  points on the head, in the scene
/// \param photo   [x, y] of each point in the photo, in pixels, y down
/// \param target  the point that the camera looks at
/// \return        position of the camera; similarity [a, b, x, y] from the photo's pixels (y up) to the image plane at
///                distance 1; error: root mean square at the head, in scene units
export function matchCamera(points, photo, target) {
  const from = photo.map(([x, y]) => [x, -y]);
  const at = (numbers) => {
    const position = positionOf(numbers, target);
    const back = new Matrix4().lookAt(position, target, new Vector3(0, 1, 0)).setPosition(position).invert();
    const seen = points.map((point) => {
      const { x, y, z } = point.clone().applyMatrix4(back);
      return [x / -z, y / -z];
    });
    return { ...similarityOf(from, seen), position };
  };
  const distances = points.length >= enough ? away : [6.4];
  let best = null;
  const consider = (numbers) => {
    const found = at(numbers);
    if (best && found.share >= best.share) return false;
    best = { ...found, numbers };
    return true;
  };
  for (const distance of distances) {
    for (let yaw = -1.6; yaw <= 1.6; yaw += 0.1) for (let pitch = -0.8; pitch <= 0.8; pitch += 0.1) consider([yaw, pitch, distance]);
  }
  // Pattern search (Hooke and Jeeves 1961).
  for (let step = 0.05; step > 1e-4; step /= 2) {
    for (let goes = true; goes;) {
      const { numbers: [yaw, pitch, distance] } = best;
      goes = [[step, 0, 0], [-step, 0, 0], [0, step, 0], [0, -step, 0], ...(distances.length > 1 ? [[0, 0, step], [0, 0, -step]] : [])]
        .map(([dyaw, dpitch, longer]) => consider([yaw + dyaw, pitch + dpitch, Math.min(14, Math.max(2.3, distance * (1 + longer)))])).some(Boolean);
    }
  }
  const error = Math.sqrt(best.left / points.length) * best.numbers[2];
  return { position: best.position, similarity: best.similarity, error };
}
