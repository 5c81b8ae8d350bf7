// Marks in the scene besides robots: labels, targets, the trail of a TCP, the path of a trajectory.

import * as THREE from "three";
import { h } from "../dom";
import type { SeenTarget } from "../messages";
import type { Palette } from "./palette";

interface Label {
  readonly element: HTMLElement;
  readonly at: () => THREE.Vector3;
}

const WIDE = 50; // px between two labels in one line
const TALL = 13; // px between two lines of labels

export class Labels {
  readonly element = h("div", { class: "labels", "aria-hidden": "true" });
  private readonly labels = new Map<string, Label[]>();

  /** Replace the labels of a kind; `at` returns the position of one when it is drawn. */
  set(kind: string, names: readonly { text: string; at: () => THREE.Vector3 }[]): void {
    this.labels.set(kind, names.map(({ text, at }) => ({ element: h("span", {}, text), at })));
    this.element.replaceChildren(...[...this.labels.values()].flat().map((label) => label.element));
  }

  draw(camera: THREE.Camera, width: number, height: number): void {
    const placed: [number, number][] = [];
    for (const { element, at } of [...this.labels.values()].flat()) {
      const seen = at().project(camera);
      const inside = Math.abs(seen.x) < 1 && Math.abs(seen.y) < 1 && seen.z < 1;
      element.hidden = !inside;
      if (!inside) continue;
      const x = ((seen.x + 1) / 2) * width;
      let y = ((1 - seen.y) / 2) * height;
      // A robot at its target has two names in one place: one below the other.
      while (placed.some(([px, py]) => Math.abs(px - x) < WIDE && Math.abs(py - y) < TALL)) y += TALL;
      placed.push([x, y]);
      element.style.transform = `translate(${x}px, ${y}px)`;
    }
  }
}

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

const POINTS = 3000;
const APART = 5e-4; // m between two points

export class Trail {
  readonly line: THREE.Line;
  private readonly places = new Float32Array(POINTS * 3);
  private readonly attribute = new THREE.BufferAttribute(this.places, 3);
  private readonly material: THREE.LineBasicMaterial;
  private count = 0;
  private last: THREE.Vector3 | null = null;

  constructor(private readonly palette: Palette) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", this.attribute);
    geometry.setDrawRange(0, 0);
    this.material = new THREE.LineBasicMaterial({ color: palette.accent });
    this.line = new THREE.Line(geometry, this.material);
    this.line.frustumCulled = false;
  }

  paint(): void {
    this.material.color.set(this.palette.accent);
  }

  add(place: THREE.Vector3): void {
    if (this.last && this.last.distanceTo(place) < APART) return;
    if (this.count === POINTS) {
      // Half is dropped at once: moving all for each point would cost more than drawing.
      this.places.copyWithin(0, (POINTS / 2) * 3);
      this.count = POINTS / 2;
    }
    place.toArray(this.places, this.count * 3);
    this.last = place;
    this.count += 1;
    this.attribute.needsUpdate = true;
    this.line.geometry.setDrawRange(0, this.count);
  }

  clear(): void {
    this.count = 0;
    this.last = null;
    this.line.geometry.setDrawRange(0, 0);
  }
}

export function drawnWay(
  way: readonly (readonly number[])[], warmth: readonly number[], marks: readonly number[], palette: Palette,
): THREE.Object3D[] {
  if (way.length < 2) return [];
  const points = way.map((point) => new THREE.Vector3(...point));
  const geometry = new THREE.BufferGeometry().setFromPoints(points);
  const calm = new THREE.Color(palette.frame[2]);
  const warm = new THREE.Color(palette.limit);
  const colours = points.flatMap((_, i) => calm.clone().lerp(warm, warmth[i] ?? 0).toArray());
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
