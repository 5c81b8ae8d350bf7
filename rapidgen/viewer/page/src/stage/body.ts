// A robot's links from its description: with meshes if it has any, coloured at limits.

import * as THREE from "three";
import URDFLoader, { type URDFRobot } from "urdf-loader";
import type { Meshes } from "./meshes";
import type { Palette } from "./palette";

type Skin = THREE.MeshLambertMaterial;
export type Nearness = "housing" | "near" | "limit";

export class Body {
  readonly urdf: URDFRobot;
  /** Resolves when all meshes are loaded or have failed; to whether there were any. */
  readonly ready: Promise<boolean>;
  private readonly skins = new Map<string, Skin[]>();
  private readonly near = new Map<string, Nearness>();

  /** `shade`: everything in one material. */
  constructor(urdf: string, meshes: Meshes, private readonly palette: Palette, private readonly shade: THREE.Material | null = null) {
    const coming: Promise<void>[] = [];
    const loader = new URDFLoader(new THREE.LoadingManager());
    loader.parseCollision = false;
    loader.loadMeshCb = (name, _manager, material, done) => {
      coming.push(meshes.load(name).then((mesh) => {
        if (mesh) dye(mesh, material as THREE.MeshPhongMaterial);
        const part = mesh ?? new THREE.Mesh();
        done(part);
        if (!mesh) bone(part);
      }));
    };
    this.urdf = loader.parse(urdf);
    this.dress();
    this.ready = Promise.all(coming).then(() => {
      if (coming.length) this.dress();
      return coming.length > 0;
    });
  }

  /** Separate materials for each link: one may be red while others are not. */
  private dress(): void {
    for (const [name, link] of Object.entries(this.urdf.links)) {
      const made = new Map<string, Skin>();
      for (const part of own(link)) {
        if (this.shade) part.material = this.shade;
        else part.material = Array.isArray(part.material)
          ? part.material.map((one) => this.skin(one as Skin, made)) : this.skin(part.material as Skin, made);
      }
      this.skins.set(name, [...made.values()]);
    }
    this.paint();
  }

  private skin(given: Skin, made: Map<string, Skin>): Skin {
    const known = made.get(given.uuid) ?? made.get(given.name);
    if (known) return known;
    const { name, color, opacity, transparent, side, vertexColors } = given;
    const skin = new THREE.MeshLambertMaterial({ name, color, opacity, transparent, side, vertexColors: vertexColors ?? false });
    made.set(name === "body" || name === "housing" ? name : given.uuid, skin);
    return skin;
  }

  /** Apply the theme's colours to parts without their own. */
  paint(): void {
    for (const [name, skins] of this.skins) {
      const near = this.near.get(name) ?? "housing";
      const housed = skins.some((skin) => skin.name === "housing");
      for (const skin of skins) {
        if (skin.name === "housing") skin.color.set(this.palette[near]);
        else if (skin.name === "body") skin.color.set(this.palette.body);
        // A link without a housing glows as a whole.
        if (near !== "housing" && !housed) skin.emissive.set(this.palette[near]).multiplyScalar(0.6);
        else skin.emissive.set(0);
      }
    }
  }

  /** Mark the distance of a link's joint from its limits. */
  warn(link: string, near: Nearness): boolean {
    if ((this.near.get(link) ?? "housing") === near) return false;
    this.near.set(link, near);
    return true;
  }

  parts(): Record<string, [number, number[], number[]][]> {
    const found: Record<string, [number, number[], number[]][]> = {};
    this.urdf.updateMatrixWorld(true);
    for (const [name, link] of Object.entries(this.urdf.links)) {
      const inverse = link.matrixWorld.clone().invert();
      found[name] = [...own(link)].flatMap((part) => {
        const corners = part.geometry.getAttribute("position");
        if (!corners) return [];
        const shape = part.geometry.clone().applyMatrix4(inverse.clone().multiply(part.matrixWorld));
        const box = new THREE.Box3().setFromBufferAttribute(shape.getAttribute("position") as THREE.BufferAttribute);
        return [[corners.count, box.min.toArray(), box.max.toArray()]];
      });
    }
    return found;
  }

  colours(link: string): string[] {
    return (this.skins.get(link) ?? []).map((skin) => skin.color.getHexString());
  }

  /** Hide the links, not their attachments. */
  bare(alone: boolean): void {
    for (const skins of this.skins.values()) for (const skin of skins) skin.visible = !alone;
  }
}

/** Apply the description's colour to parts without their own. */
function dye(mesh: THREE.Object3D, material: THREE.MeshPhongMaterial): void {
  const named = material.name === "own";
  mesh.traverse((part) => {
    if (!(part instanceof THREE.Mesh)) return;
    const plain = (part.material as Skin).name === "body";
    if (plain && named) part.material = material;
  });
}

/** Solids from the link's joint to the next ones, instead of a missing mesh. */
function bone(part: THREE.Object3D): void {
  const visual = part.parent;
  const link = visual?.parent;
  if (!visual || !link || link.userData["bone"]) return;
  link.userData["bone"] = true;
  visual.position.set(0, 0, 0);
  visual.quaternion.identity();
  visual.scale.set(1, 1, 1);
  const ends = link.children.filter((child) => "isURDFJoint" in child).map((child) => child.position);
  for (const end of ends) {
    const length = end.length();
    if (length < 0.005) continue;
    const solid = new THREE.Mesh(new THREE.CylinderGeometry(length * 0.13, length * 0.16, length, 24), named("body"));
    solid.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), end.clone().normalize());
    solid.position.copy(end).multiplyScalar(0.5);
    visual.add(solid);
  }
}

const named = (name: string): Skin => new THREE.MeshLambertMaterial({ name });

function* own(link: THREE.Object3D): Generator<THREE.Mesh> {
  for (const child of link.children) {
    if ("isURDFJoint" in child || "isURDFLink" in child) continue;
    if (child instanceof THREE.Mesh) yield child;
    yield* own(child);
  }
}
