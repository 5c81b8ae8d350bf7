// The way of a trajectory: a line from calm to warm by its speed, marks where something was found.

import * as THREE from "three";
import type { Palette } from "./palette";

export function drawnWay(
  way: readonly (readonly number[])[], pace: readonly number[], marks: readonly number[], palette: Palette,
): THREE.Object3D[] {
  if (way.length < 2) return [];
  const points = way.map((point) => new THREE.Vector3(...point));
  const geometry = new THREE.BufferGeometry().setFromPoints(points);
  const fastest = Math.max(1e-9, ...pace);
  const calm = new THREE.Color(palette.frame[2]);
  const warm = new THREE.Color(palette.limit);
  const colours = points.flatMap((_, i) => calm.clone().lerp(warm, (pace[i] ?? 0) / fastest).toArray());
  geometry.setAttribute("color", new THREE.Float32BufferAttribute(colours, 3));
  const line = new THREE.Line(geometry, new THREE.LineBasicMaterial({ vertexColors: true }));
  const ball = new THREE.SphereGeometry(0.012, 12, 8);
  const found = marks.flatMap((i) => {
    const at = points[i];
    if (!at) return [];
    const mark = new THREE.Mesh(ball, new THREE.MeshBasicMaterial({ color: palette.near }));
    mark.position.copy(at);
    return [mark];
  });
  return [line, ...found];
}
