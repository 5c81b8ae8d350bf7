// The seam of the page: what a panel is, and what it may use.

import type { Link } from "./link";
import type { Request, Scene } from "./messages";
import type { Stage } from "./stage/stage";

/** What a panel is given. */
export interface View {
  readonly link: Link;
  /** The robots in space; null without WebGL. */
  readonly stage: Stage | null;
  /** Ask, and show the reason where it is refused: whether it was done. */
  order(request: Request): Promise<boolean>;
  /** Show a short message. */
  notice(text: string, kind?: "plain" | "fault"): void;
}

/** A tab beside the robots. */
export interface Panel {
  readonly id: string;
  readonly title: string;
  readonly element: HTMLElement;
  /** Of what it is a face; absent: of everything. */
  readonly kinds?: readonly Scene["kind"][];
  /** Called when the tab is shown and hidden: what nobody sees need not be kept up. */
  shown?(visible: boolean): void;
}

export type MakePanel = (view: View) => Panel;
