import type { Axis } from "../messages";

/** How near an axis is to its limits; the words are those of the palette. */
export function nearness(axis: Axis, value: number): "housing" | "near" | "limit" {
  const room = Math.min(value - axis.lower, axis.upper - value);
  const range = axis.upper - axis.lower;
  if (!(range > 0) || room > 0.05 * range) return "housing";
  return room > 0.01 * range ? "near" : "limit";
}
