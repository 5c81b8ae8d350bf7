// Colours of the scene by theme, matching those of page.css.

import type { Axis } from "../messages";

export interface Palette {
  ground: string;
  grid: string;
  body: string;
  housing: string;
  near: string;
  limit: string;
  accent: string;
  frame: [string, string, string];
}

const LIGHT: Palette = {
  ground: "#f3f4f5", grid: "#d5d9dc", body: "#f4f2ee", housing: "#4a5660",
  near: "#e0a030", limit: "#d0402c", accent: "#d9662b", frame: ["#d0402c", "#3a9a50", "#2f6fd0"],
};
const DARK: Palette = {
  ground: "#14181b", grid: "#2a3136", body: "#c9c6bf", housing: "#5c6973",
  near: "#e5ac45", limit: "#ec5a44", accent: "#f0894a", frame: ["#ec5a44", "#57b86d", "#5b95ef"],
};

export const isDark = (): boolean => {
  const chosen = document.documentElement.dataset["theme"];
  return chosen ? chosen === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
};

/** A palette that is the theme's; `renewed` after the theme has changed. */
export function palette(): Palette & { renew(): void } {
  const own = { ...LIGHT, renew: () => void Object.assign(own, isDark() ? DARK : LIGHT) };
  own.renew();
  return own;
}

/** Distance of an axis from its limits, as a key of the palette. */
export function nearness(axis: Axis, value: number): "housing" | "near" | "limit" {
const margin = Math.min(value - axis.lower, axis.upper - value);
  const range = axis.upper - axis.lower;
  if (!(range > 0) || margin > 0.05 * range) return "housing";
  return margin > 0.01 * range ? "near" : "limit";
}
