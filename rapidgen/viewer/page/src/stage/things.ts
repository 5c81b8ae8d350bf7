// Objects, zones and tools of the cell, made of their shapes.

import * as THREE from "three";
import { ConvexGeometry } from "three/addons/geometries/ConvexGeometry.js";
import type { SeenShape, SeenThing } from "../messages";
import type { Meshes } from "./meshes";
import type { Palette } from "./palette";
import { place } from "./robot";

const WIDE = 6; // m: the part of a half-space that is drawn
const OBJECT = "#9aa5ad";
const TOOL = "#5f7688";

export interface DrawnThing {
  readonly root: THREE.Group;
  /** Resolves when its meshes have arrived or failed; to whether there were any. */
  readonly ready: Promise<boolean>;
}

/** Objects are solid, zones transparent with edges; a zone to keep in has edges only. */
export function drawnThing(thing: SeenThing, meshes: Meshes, palette: Palette): DrawnThing {
  const root = new THREE.Group();
  root.name = thing.name;
  root.userData["endless"] = thing.shapes.some((shape) => shape.kind === "half_space");
  const zone = thing.role === "keep-in" || thing.role === "keep-out";
  const skin = zone ? glass(thing.role === "keep-out" ? palette.limit : palette.frame[1])
    : new THREE.MeshLambertMaterial({ color: thing.role === "tool" ? TOOL : OBJECT });
  const coming = thing.shapes.map(async (shape) => {
    if (shape.kind === "mesh") {
      const mesh = await meshes.load(shape.mesh);
      if (!mesh) return false;
      mesh.scale.multiplyScalar(shape.size[0] ?? 1);
      mesh.traverse((part) => {
        const own = part instanceof THREE.Mesh ? (part.material as THREE.MeshLambertMaterial) : null;
        if (own?.name === "body") own.color.set(OBJECT);
      });
      root.add(stand(shape, mesh));
      return true;
    }
    const geometry = solid(shape);
    if (!geometry) return false;
    const endless = shape.kind === "half_space";
    // Everything is seen through the zone that the robot is in.
    if (thing.role !== "keep-in") root.add(stand(shape, new THREE.Mesh(geometry, endless ? glass(OBJECT) : skin)));
    if (zone || endless) root.add(stand(shape, new THREE.LineSegments(new THREE.EdgesGeometry(geometry), new THREE.LineBasicMaterial({ color: skin.color }))));
    return false;
  });
  return { root, ready: Promise.all(coming).then((came) => came.includes(true)) };
}

function stand(shape: SeenShape, part: THREE.Object3D): THREE.Object3D {
  const group = new THREE.Group();
  place(group, shape.pose);
  return group.add(part);
}

export const glass = (color: THREE.ColorRepresentation): THREE.MeshLambertMaterial => new THREE.MeshLambertMaterial({
  color, transparent: true, opacity: 0.16, depthWrite: false, side: THREE.DoubleSide,
});

/** The surface of a shape in its frame; null: a mesh, or a hull of too few corners. */
export function solid(shape: SeenShape): THREE.BufferGeometry | null {
  const [a = 0, b = 0, c = 0] = shape.size;
  switch (shape.kind) {
    case "box": return new THREE.BoxGeometry(a, b, c);
    case "sphere": return new THREE.SphereGeometry(a, 24, 16);
    // three.js has their axes along y, the cell file along z.
    case "cylinder": return new THREE.CylinderGeometry(a, a, b, 32).rotateX(Math.PI / 2);
    case "capsule": return new THREE.CapsuleGeometry(a, b, 8, 24).rotateX(Math.PI / 2);
    case "half_space": return new THREE.PlaneGeometry(WIDE, WIDE);
    case "hull": return shape.corners.length < 4 ? null : new ConvexGeometry(shape.corners.map((at) => new THREE.Vector3(...at)));
    case "mesh": return null;
  }
}
