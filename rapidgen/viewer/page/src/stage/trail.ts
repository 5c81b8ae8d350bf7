// Where the TCP has been.

import * as THREE from "three";
import type { Palette } from "./palette";

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
      // Half is forgotten at once: moving all for each point would cost more than drawing.
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
