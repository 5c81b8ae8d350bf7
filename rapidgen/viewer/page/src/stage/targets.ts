// Where the moves of programs go: a small frame each, all of a robot in one drawing.

import * as THREE from "three";
import type { SeenTarget } from "../messages";
import type { Palette } from "./palette";

const ARM = 0.05; // m

export class TargetMarks {
  readonly root = new THREE.Group();

  constructor(private readonly targets: readonly SeenTarget[], palette: Palette) {
    const points: number[] = [];
    const colours: number[] = [];
    for (const { pose } of targets) {
      const [w, x, y, z] = pose.orientation;
      const turned = new THREE.Quaternion(x, y, z, w);
      const at = new THREE.Vector3(...pose.position);
      palette.frame.forEach((colour, i) => {
        const end = new THREE.Vector3().setComponent(i, ARM).applyQuaternion(turned).add(at);
        points.push(...at.toArray(), ...end.toArray());
        const tone = new THREE.Color(colour).toArray();
        colours.push(...tone, ...tone);
      });
    }
    const arms = new THREE.BufferGeometry();
    arms.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
    arms.setAttribute("color", new THREE.Float32BufferAttribute(colours, 3));
    const dots = new THREE.BufferGeometry().setFromPoints(targets.map(({ pose }) => new THREE.Vector3(...pose.position)));
    this.root.add(
      new THREE.LineSegments(arms, new THREE.LineBasicMaterial({ vertexColors: true })),
      new THREE.Points(dots, new THREE.PointsMaterial({ color: palette.accent, size: 6, sizeAttenuation: false })),
    );
  }

  /** Names with their places in the world. */
  names(): { text: string; at: () => THREE.Vector3 }[] {
    return this.targets.filter((target) => target.name).map(({ name, pose }) => ({
      text: name, at: () => this.root.localToWorld(new THREE.Vector3(...pose.position)),
    }));
  }

  dispose(): void {
    this.root.removeFromParent();
    this.root.traverse((part) => {
      if (part instanceof THREE.LineSegments || part instanceof THREE.Points) part.geometry.dispose();
    });
  }
}
