// A source: pointers and breakpoints in it, values under the mouse.
//
// It is in a shadow root: CodeMirror constructs its styles there, which the page's policy permits.

import { StreamLanguage, HighlightStyle, syntaxHighlighting } from "@codemirror/language";
import { tags } from "@lezer/highlight";
import { EditorState, RangeSet, StateEffect, StateField, type Extension } from "@codemirror/state";
import { Decoration, EditorView, GutterMarker, gutter, highlightActiveLine, hoverTooltip, keymap, lineNumbers, type BlockInfo, type ViewUpdate } from "@codemirror/view";
import { h } from "../dom";

const WORDS = new Set(("module endmodule proc endproc func endfunc trap endtrap record endrecord alias local task " +
  "var pers const inout ref if then elseif else endif for from to step do endfor while endwhile test case default " +
  "endtest return goto raise retry trynext exit connect with error undo backward nostepin sysmodule viewonly " +
  "readonly noview not and or xor div mod").split(" "));
const VALUES = new Set(["true", "false"]);

const language = StreamLanguage.define({
  token(stream) {
    if (stream.eatSpace()) return null;
    if (stream.match(/^!.*/)) return "comment";
    if (stream.match(/^"(?:[^"]|"")*"?/)) return "string";
    if (stream.match(/^(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?/)) return "number";
    const word = stream.match(/^[A-Za-z_]\w*/) as RegExpMatchArray | null;
    if (word) {
      const known = word[0].toLowerCase();
      return WORDS.has(known) ? "keyword" : VALUES.has(known) ? "number" : null;
    }
    stream.next();
    return null;
  },
});

const colours = HighlightStyle.define([
  { tag: tags.keyword, color: "var(--accent)" },
  { tag: tags.comment, color: "var(--soft)", fontStyle: "italic" },
  { tag: tags.string, color: "var(--good)" },
  { tag: tags.number, color: "var(--warn)" },
]);

export const rapid = [language, syntaxHighlighting(colours)];

/** Marks of a source besides its text; lines from 1. */
export interface Marks {
  /** Breakpoints: pausing always, on a condition, or only logging. */
  readonly breakpoints: ReadonlyMap<number, "plain" | "conditional" | "log">;
  readonly program: number | null;
  readonly motion: number | null;
  /** Executions of lines; empty: not counted. */
  readonly covered: Readonly<Record<number, number>>;
}

export interface EditorActions {
  /** Set or remove a breakpoint. */
  toggle(line: number): void;
  /** The value of an expression as text, or null. */
  value(expression: string): Promise<string | null>;
  /** The cursor is in a line. */
  moved(line: number): void;
}

const NONE: Marks = { breakpoints: new Map(), program: null, motion: null, covered: {} };
const setMarks = StateEffect.define<Marks>();
const marksOf = StateField.define<Marks>({
  create: () => NONE,
  update: (marks, change) => change.effects.reduce((now, e) => (e.is(setMarks) ? e.value : now), marks),
  provide: (field) => EditorView.decorations.compute([field], (state) => {
    const { program, motion } = state.field(field);
    const found = [[program, "program"], [motion, "motion"]]
      .filter((pair): pair is [number, string] => pair[0] !== null && (pair[0] as number) <= state.doc.lines)
      .map(([line, kind]) => Decoration.line({ class: `cm-at-${kind}` }).range(state.doc.line(line).from));
    return RangeSet.of(found, true);
  }),
});

class Sign extends GutterMarker {
  constructor(private readonly text: string, private readonly kind: string, private readonly title: string) {
    super();
  }
  override eq(other: Sign): boolean {
    return other.kind === this.kind && other.text === this.text;
  }
  override toDOM(): Node {
    return h("span", { class: this.kind, title: this.title }, this.text);
  }
}

const SIGNS = {
  plain: new Sign("●", "cm-break", "Breakpoint"),
  conditional: new Sign("◆", "cm-break", "Breakpoint with a condition"),
  log: new Sign("▤", "cm-break", "Log point"),
};
const PROGRAM = new Sign("▶", "cm-pointer-program", "Program pointer");
const MOTION = new Sign("➤", "cm-pointer-motion", "Motion pointer");

const changed = (update: ViewUpdate): boolean =>
  update.startState.field(marksOf) !== update.state.field(marksOf);
const lineOf = (view: EditorView, block: BlockInfo): number => view.state.doc.lineAt(block.from).number;

function signs(actions: EditorActions): Extension {
  return [
    gutter({
      class: "cm-breaks",
      lineMarker: (view, block) => {
        const kind = view.state.field(marksOf).breakpoints.get(lineOf(view, block));
        return kind ? SIGNS[kind] : null;
      },
      lineMarkerChange: changed,
      initialSpacer: () => SIGNS.plain,
      domEventHandlers: {
        mousedown(view, block) {
          actions.toggle(lineOf(view, block));
          return true;
        },
      },
    }),
    lineNumbers({ domEventHandlers: { mousedown(view, block) {
      actions.toggle(lineOf(view, block));
      return true;
    } } }),
    gutter({
      class: "cm-pointers",
      lineMarker: (view, block) => {
        const { program, motion } = view.state.field(marksOf);
        const line = lineOf(view, block);
        return line === program ? PROGRAM : line === motion ? MOTION : null;
      },
      lineMarkerChange: changed,
      initialSpacer: () => PROGRAM,
    }),
    gutter({
      class: "cm-covered",
      lineMarker: (view, block) => {
        const hits = view.state.field(marksOf).covered[lineOf(view, block)];
        if (hits === undefined) return null;
        return new Sign(hits ? String(hits) : "–", hits ? "cm-reached" : "cm-missed",
          hits ? `Executed ${hits} times` : "Not executed");
      },
      lineMarkerChange: changed,
    }),
  ];
}

const WORD = /[A-Za-z_]\w*(?:\.[A-Za-z_]\w*|\{[\w,\s]+\})*/g;

function values(actions: EditorActions): Extension {
  return hoverTooltip(async (view, at) => {
    const line = view.state.doc.lineAt(at);
    for (const match of line.text.matchAll(WORD)) {
      const from = line.from + match.index;
      if (from <= at && at <= from + match[0].length) {
        const text = await actions.value(match[0]);
        if (text === null) return null;
        return { pos: from, above: true, create: () => ({ dom: h("div", { class: "cm-value" }, `${match[0]} = ${text}`) }) };
      }
    }
    return null;
  }, { hoverTime: 250 });
}

const theme = EditorView.theme({
  "&": { height: "100%", fontSize: "12px", color: "var(--ink)", backgroundColor: "var(--ground)" },
  ".cm-scroller": { fontFamily: "ui-monospace, 'DejaVu Sans Mono', monospace", lineHeight: "1.5" },
  ".cm-gutters": { backgroundColor: "var(--paper)", color: "var(--soft)", borderRight: "1px solid var(--line)" },
  ".cm-breaks": { cursor: "pointer", width: "1.3em", textAlign: "center" },
  ".cm-lineNumbers": { cursor: "pointer" },
  ".cm-break": { color: "var(--bad)" },
  ".cm-pointers": { width: "1.2em" },
  ".cm-pointer-program": { color: "var(--accent)" },
  ".cm-pointer-motion": { color: "var(--good)" },
  ".cm-at-program": { backgroundColor: "color-mix(in srgb, var(--accent) 20%, transparent)" },
  // Colours of words would be hard to read on it.
  ".cm-at-program *": { color: "var(--ink)" },
  ".cm-at-motion": { boxShadow: "inset 3px 0 var(--good)" },
  ".cm-reached": { color: "var(--good)" },
  ".cm-missed": { color: "var(--bad)" },
  ".cm-activeLine": { outline: "1px dotted var(--line)", backgroundColor: "transparent" },
  ".cm-at-program.cm-activeLine": { backgroundColor: "color-mix(in srgb, var(--accent) 20%, transparent)" },
  ".cm-tooltip": { backgroundColor: "var(--paper)", border: "1px solid var(--line)", borderRadius: "6px" },
  ".cm-value": { padding: ".2rem .5rem", maxWidth: "30rem", overflowWrap: "anywhere" },
  "&.cm-focused": { outline: "none" },
});

export class SourceEditor {
  readonly element = h("div", { class: "source" });
  private readonly view: EditorView;
  private readonly extensions: Extension;
  private marks = NONE;

  constructor(actions: EditorActions) {
    const root = this.element.attachShadow({ mode: "open" });
    this.extensions = [
      signs(actions), values(actions), marksOf, rapid, theme, highlightActiveLine(),
      EditorState.readOnly.of(true),
      EditorView.updateListener.of((update) => {
        if (update.selectionSet) actions.moved(update.state.doc.lineAt(update.state.selection.main.head).number);
      }),
      EditorView.contentAttributes.of({ "aria-label": "Source", "aria-readonly": "true", tabindex: "0" }),
      keymap.of([{ key: "F9", run: () => {
        actions.toggle(this.line);
        return true;
      } }]),
    ];
    this.view = new EditorView({ root, parent: root, state: this.state("") });
  }

  private state(text: string): EditorState {
    return EditorState.create({ doc: text, extensions: this.extensions });
  }

  /** The line of the cursor. */
  get line(): number {
    return this.view.state.doc.lineAt(this.view.state.selection.main.head).number;
  }

  open(text: string): void {
    this.view.setState(this.state(text));
    this.mark(this.marks);
  }

  mark(marks: Marks): void {
    this.marks = marks;
    this.view.dispatch({ effects: setMarks.of(marks) });
  }

  /** Bring a line into view, and the cursor into it. The view stays if it has the line: the mouse may be over it. */
  go(line: number): void {
    const doc = this.view.state.doc;
    const { from } = doc.line(Math.min(Math.max(line, 1), doc.lines));
    const { top, bottom } = this.view.lineBlockAt(from);
    const { scrollTop, clientHeight } = this.view.scrollDOM;
    const inView = top >= scrollTop && bottom <= scrollTop + clientHeight - this.view.documentPadding.top;
    this.view.dispatch({ selection: { anchor: from }, effects: inView ? [] : EditorView.scrollIntoView(from, { y: "center" }) });
  }

  /** For tests: text and marks. */
  get seen(): { text: string; program: number | null; motion: number | null; breakpoints: number[] } {
    const { program, motion, breakpoints } = this.marks;
    return { text: this.view.state.doc.toString(), program, motion, breakpoints: [...breakpoints.keys()] };
  }
}
