// RAPID's words for the editor: enough to colour, not to parse.

import { StreamLanguage, HighlightStyle, syntaxHighlighting } from "@codemirror/language";
import { tags } from "@lezer/highlight";

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
