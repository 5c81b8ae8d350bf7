// Meshes of descriptions: each is fetched and read once for all robots. Broken ones are reported.

import * as THREE from "three";
import { ColladaLoader } from "three/addons/loaders/ColladaLoader.js";
import { OBJLoader } from "three/addons/loaders/OBJLoader.js";
import { STLLoader } from "three/addons/loaders/STLLoader.js";

const MOST = 3_000_000; // triangles of one mesh

export class Meshes {
  private readonly known = new Map<string, Promise<THREE.Object3D | null>>();

  constructor(private readonly failed: (why: string) => void) {}

  /** A copy of a mesh that shares its geometry; null: it is missing, and reported. */
  async load(name: string): Promise<THREE.Object3D | null> {
    if (!name) return null; // the server has reported why
    let found = this.known.get(name);
    if (!found) this.known.set(name, found = this.fetched(name));
    return (await found)?.clone() ?? null;
  }

  private async fetched(name: string): Promise<THREE.Object3D | null> {
    try {
      const response = await fetch(`files/${encodeURIComponent(name)}`);
      if (!response.ok) throw new Error(`the server says ${response.status}`);
      return checked(read(name, await response.arrayBuffer()));
    } catch (why) {
      this.failed(`${name}: ${(why as Error).message}`);
      return null;
    }
  }
}

function read(name: string, data: ArrayBuffer): THREE.Object3D {
  if (name.endsWith(".stl")) return new THREE.Mesh(new STLLoader().parse(data), plain());
  const text = new TextDecoder().decode(data);
  if (name.endsWith(".obj")) return uncoloured(new OBJLoader().parse(text));
  const document = new DOMParser().parseFromString(text, "text/xml");
  if (document.documentElement.localName !== "COLLADA") throw new Error("it is no COLLADA");
  // Textures would be further files with further names.
  for (const images of [...document.querySelectorAll("library_images")]) images.remove();
  const found = new ColladaLoader().parse(new XMLSerializer().serializeToString(document), "");
  if (!found) throw new Error("it cannot be read");
  return found.scene;
}

const plain = (): THREE.Material => new THREE.MeshLambertMaterial({ name: "body" });

function uncoloured(group: THREE.Object3D): THREE.Object3D {
  group.traverse((part) => { if (part instanceof THREE.Mesh) part.material = plain(); });
  return group;
}

/** Only surfaces, in plain materials, up to a limit. */
function checked(found: THREE.Object3D): THREE.Object3D {
  const others: THREE.Object3D[] = [];
  let triangles = 0;
  found.traverse((part) => {
    if (part instanceof THREE.Mesh) {
      const geometry = part.geometry as THREE.BufferGeometry;
      if (!geometry.getAttribute("normal")) geometry.computeVertexNormals();
      triangles += (geometry.index ?? geometry.getAttribute("position"))?.count / 3 || 0;
      part.material = Array.isArray(part.material) ? part.material.map(lambert) : lambert(part.material as THREE.Material);
    } else if (part instanceof THREE.Light || part instanceof THREE.Camera || part instanceof THREE.Line || part instanceof THREE.Points) {
      others.push(part);
    }
  });
  for (const part of others) part.removeFromParent();
  const box = new THREE.Box3().setFromObject(found);
  if (!triangles || box.isEmpty()) throw new Error("it has no surface");
  if (![...box.min.toArray(), ...box.max.toArray()].every(Number.isFinite)) throw new Error("its corners are no numbers");
  if (triangles > MOST) throw new Error(`it has ${Math.round(triangles)} triangles, more than ${MOST}`);
  return found;
}

/** CAD surfaces are drawn on both sides. */
function lambert(given: THREE.Material): THREE.MeshLambertMaterial {
  const { color, vertexColors, opacity, transparent, name } = given as THREE.MeshLambertMaterial;
  return new THREE.MeshLambertMaterial({
    name: name === "body" ? "body" : "own", color: color ?? "#c8c8c8", side: THREE.DoubleSide, vertexColors, opacity, transparent,
  });
}
