// Collision checks in the scene: shapes of bodies, red where they touch, and lines between nearest points.

import * as THREE from "three";
import type { CollisionBodies, Collisions, SeenPair } from "../messages";
import type { Palette } from "./palette";
import { place } from "./robot";
import { glass, solid } from "./things";

type Verdict = "contact" | "too near" | "free";

export class CollisionMarks {
  readonly root = new THREE.Group();
  private readonly shapes = new THREE.Group();
  private readonly lines = new THREE.Group();
  private nodes: THREE.Group[] = [];
  private readonly bodies = new Map<string, THREE.Group>();
  private readonly skins: Record<Verdict, THREE.MeshLambertMaterial>;
  private near: readonly SeenPair[] = [];
  /** Show all shapes, not only those that touch or are too near. */
  all = false;
  /** Show lines between nearest points. */
  distances = true;

  constructor(private readonly palette: Palette) {
    this.skins = { contact: glass(palette.limit), "too near": glass(palette.near), free: glass(palette.frame[2]) };
    this.skins.contact.opacity = 0.75;
    this.skins["too near"].opacity = 0.55;
    this.root.add(this.shapes, this.lines);
  }

  /** Follow the theme. */
  paint(): void {
    this.skins.contact.color.set(this.palette.limit);
    this.skins["too near"].color.set(this.palette.near);
    this.skins.free.color.set(this.palette.frame[2]);
  }

  /** Replace the bodies. */
  build({ bodies }: Pick<CollisionBodies, "bodies">): void {
    clear(this.shapes);
    clear(this.lines);
    this.bodies.clear();
    this.near = [];
    const count = Math.max(0, ...bodies.map((body) => body.node + 1));
    this.nodes = Array.from({ length: count }, () => new THREE.Group());
    for (const node of this.nodes) this.shapes.add(node);
    for (const body of bodies) {
      // Zones are drawn with the cell.
      if (body.role === "zone") continue;
      const group = new THREE.Group();
      group.name = body.name;
      for (const shape of body.shapes) {
        const geometry = solid(shape);
        if (!geometry) continue;
        const part = new THREE.Mesh(geometry, this.skins.free);
        place(part, shape.pose);
        group.add(part);
      }
      this.bodies.set(body.name, group);
      (this.nodes[body.node] ?? this.shapes).add(group);
    }
    this.update();
  }

  show({ nodes, near }: Pick<Collisions, "nodes" | "near">): void {
    nodes.forEach((pose, i) => {
      const node = this.nodes[i];
      if (node) place(node, pose);
    });
    this.near = near;
    this.update();
  }

  /** Apply verdicts and switches. */
  update(): void {
    const worst = new Map<string, Verdict>();
    for (const { bodies, verdict } of this.near) {
      if (verdict === "near") continue;
      for (const body of bodies) if (worst.get(body) !== "contact") worst.set(body, verdict);
    }
    for (const [name, group] of this.bodies) {
      const verdict = worst.get(name) ?? "free";
      group.visible = this.all || verdict !== "free";
      for (const part of group.children) if (part instanceof THREE.Mesh) part.material = this.skins[verdict];
    }
    clear(this.lines);
    if (!this.distances) return;
    for (const { points, verdict } of this.shown) this.lines.add(...this.line(points, verdict));
  }

  /** Pairs with a line: all that touch or are too near, else the nearest one. */
  private get shown(): readonly SeenPair[] {
    const met = this.near.filter((pair) => pair.verdict !== "near");
    return met.length ? met : this.near.slice(0, 1);
  }

  /** Distances in mm with their places. */
  labels(): { text: string; at: () => THREE.Vector3 }[] {
    if (!this.distances) return [];
    return this.shown.map(({ distance, points: [a, b] }) => ({
      text: distance > 0 ? `${(distance * 1000).toFixed(1)} mm` : `contact, ${(-distance * 1000).toFixed(1)} mm deep`,
      at: () => new THREE.Vector3(...a).lerp(new THREE.Vector3(...b), 0.5),
    }));
  }

  /** For tests: bodies that are drawn, with their verdicts. */
  get seen(): Record<string, Verdict> {
    const shown = [...this.bodies].filter(([, group]) => group.visible);
    return Object.fromEntries(shown.map(([name, group]) => {
      const [part] = group.children;
      const skin = part instanceof THREE.Mesh ? part.material : this.skins.free;
      return [name, (Object.keys(this.skins) as Verdict[]).find((verdict) => this.skins[verdict] === skin) ?? "free"];
    }));
  }

  private line(points: SeenPair["points"], verdict: SeenPair["verdict"]): THREE.Object3D[] {
    const colour = verdict === "contact" ? this.palette.limit : verdict === "too near" ? this.palette.near : this.palette.frame[2];
    // Seen through the shapes, in which the points may be.
    const options = { color: colour, depthTest: false };
    const ends = points.map((point) => new THREE.Vector3(...point));
    const line = new THREE.Line(new THREE.BufferGeometry().setFromPoints(ends), new THREE.LineBasicMaterial(options));
    const dots = new THREE.Points(line.geometry, new THREE.PointsMaterial({ ...options, size: 7, sizeAttenuation: false }));
    for (const part of [line, dots]) part.renderOrder = 2;
    return [line, dots];
  }
}

function clear(group: THREE.Group): void {
  group.traverse((part) => {
    if (part instanceof THREE.Mesh || part instanceof THREE.Line || part instanceof THREE.Points) part.geometry.dispose();
  });
  group.clear();
}
