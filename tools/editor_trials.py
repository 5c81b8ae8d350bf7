"""Hold the language server's state against a fresh one, on public RAPID programs.

    python tools/editor_trials.py FOLDER [--seconds S] [--seed N] [--only edits|rename|requests]

FOLDER has repositories or backups with RAPID modules. For each third of the time:

- edits: random changes of random modules (letters, lines, statements, pasted text). Every 10th edit
  the findings of the edited module, and every 100th all findings of its program, are compared with
  those of a new workspace with the same texts.
- rename: a random symbol gets a new name. The findings must stay the same but for the name, and
  the tokens that differ must be the references.
- requests: hover, definition, references, completion, signature help and the others at every 50th
  token of a module, whole and cut off at a random place. The slowest is printed.

The script prints a log of the run; the exit code is 1 if a comparison fails or an exception comes.
"""

import argparse
import random
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

from rapidgen.diagnostics import Diagnostic, Edit, Severity, apply_edits
from rapidgen.editor import completion, formatting, hover, navigation, outline, rename, tokens
from rapidgen.editor.documents import Document, TextEdit, decode_file
from rapidgen.editor.project import is_module
from rapidgen.editor.workspace import View, Workspace
from rapidgen.rapid import parse
from rapidgen.rapid.binding import Symbol

PIECES = (
    ";", ":=", "IF ", "THEN", "ENDIF", "ENDPROC", "PROC x()", "VAR num x;", "x", ".", "\\", '"',
    "!", "(", ")", ",", "\n", "MoveL p10, v100, fine, tool0;", "RECORD r num a; ENDRECORD", "%",
    "CONST num x := 1;", "LOCAL ", "MODULE", "ENDMODULE", "1E", "\x00", "\u00e9", "\U0001f916",
)  # fmt: skip


def main() -> int:
    """Run the trials and return the exit code."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--seconds", type=float, default=90.0, help="CPU time of all trials")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", choices=("edits", "rename", "requests"))
    given = parser.parse_args()
    files = sorted(str(path) for path in given.folder.rglob("*") if is_module(path.name))
    files = [path for path in files if Path(path).is_file()]
    print(f"{len(files)} modules, seed {given.seed}")
    trials = {"edits": edits, "rename": renames, "requests": requests}
    chosen = [given.only] if given.only else list(trials)
    failures = 0
    for name in chosen:
        chance = random.Random(given.seed)
        failures += trials[name](files, chance, given.seconds / len(chosen))
    return 1 if failures else 0


def text_of(path: str) -> str:
    """Return the text of a module as an editor would open it."""
    return decode_file(Path(path).read_bytes(), "auto")


def opened(path: str, text: str | None = None) -> Workspace:
    """Return a workspace with one open document."""
    workspace = Workspace()
    workspace.open(Document(path, text_of(path) if text is None else text))
    return workspace


def is_fresh(workspace: Workspace, path: str, *, whole: bool) -> bool:
    """Compare findings with those of a new workspace with the same documents."""
    fresh = Workspace()
    for document in workspace.documents.values():
        fresh.open(Document(document.path, document.text))
    if workspace.findings_of(path) != fresh.findings_of(path):
        return False
    return not whole or all_findings(workspace) == all_findings(fresh)


def all_findings(workspace: Workspace) -> dict[str, list[Diagnostic]]:
    """Return the findings of all programs by path."""
    for _ in workspace.work():
        pass
    return {
        path: found
        for program in workspace.programs
        for path, found in sorted(program.findings.items())
    }


# -- edits ---------------------------------------------------------------------------------------


def edits(files: list[str], chance: random.Random, seconds: float) -> int:
    """Edit random modules; return the number of failed comparisons."""
    end = time.process_time() + seconds
    count = compared = failed = 0
    programs = set()
    while time.process_time() < end:
        path = chance.choice(files)
        workspace = opened(path)
        for view in workspace.views(path):
            programs.add(view.program.program.root)
        open_too = [
            view.source.path
            for program in workspace.programs
            for view in program.all_views(workspace)
        ]
        for other in chance.sample(open_too, min(2, len(open_too))):
            if other != path:
                workspace.open(Document(other, text_of(other)))
        for _ in range(100):
            document = chance.choice(list(workspace.documents.values()))
            change(document, chance)
            workspace.edited(document.path)
            count += 1
            if chance.random() < 0.3:
                workspace.findings_of(document.path)
            if count % 10 == 0:
                compared += 1
                if not is_fresh(workspace, document.path, whole=count % 100 == 0):
                    failed += 1
                    print(f"differs after edit {count}: {document.path}")
                    break
            if time.process_time() > end:
                break
    print(f"edits: {count} in {len(programs)} programs, {compared} compared, {failed} differ")
    return failed


def change(document: Document, chance: random.Random) -> None:
    """Change a document at a random place."""
    text = document.text
    start = chance.randint(0, len(text))
    kind = chance.random()
    if kind < 0.4:
        document.text = text[:start] + chance.choice(PIECES) + text[start:]
    elif kind < 0.6:
        document.text = text[:start] + text[start + chance.randint(1, 30) :]
    elif kind < 0.8:
        other = chance.randint(0, len(text))
        document.text = text[:start] + text[other : other + chance.randint(1, 200)] + text[start:]
    else:
        lines = text.splitlines(keepends=True)
        if lines:
            del lines[chance.randrange(len(lines))]
        document.text = "".join(lines)
    document.edit(None, document.text, "utf-32")


# -- rename --------------------------------------------------------------------------------------


def renames(files: list[str], chance: random.Random, seconds: float) -> int:
    """Rename random symbols; return the number of renames that changed more than the name."""
    end = time.process_time() + seconds
    done = refused = failed = 0
    folders = set()
    while time.process_time() < end:
        path = chance.choice(files)
        workspace = opened(path)
        views = workspace.views(path)
        if not views or any(d.severity is Severity.ERROR for d in views[0].module.tree.diagnostics):
            continue
        named = [t for t, s in views[0].names.names.items() if s.module is not None and t >= 0]
        if not named:
            continue
        token = chance.choice(named)
        symbol = views[0].names.names[token]
        line, column = views[0].source.position(views[0].source.starts[token])
        try:
            result = rename.rename(workspace, path, line, column, "zz_renamed")
        except rename.CannotRename as reason:
            refused += 1
            if "declared" not in str(reason) and "uses" not in str(reason):
                print(f"refused: {reason}")
            continue
        done += 1
        folders.add(str(Path(path).parent))
        if not same_but_for_name(workspace, path, symbol, result.edits):
            failed += 1
            print(f"rename of {symbol.kind} {symbol.name} changes more: {path}:{line}")
    print(f"rename: {done} in {len(folders)} folders, {refused} refused, {failed} differ")
    return failed


def same_but_for_name(
    workspace: Workspace, path: str, symbol: Symbol, changes: tuple[TextEdit, ...]
) -> bool:
    """Apply a rename and compare findings by code and line, and tokens by number."""
    before = summary(workspace)
    by_path: dict[str, list[TextEdit]] = {}
    for edit in changes:
        by_path.setdefault(edit.path, []).append(edit)
    after = Workspace()
    for changed, edits_there in by_path.items():
        text = text_of(changed)
        old = parse(text, path=changed)
        new_text = apply_edits(text, [Edit(e.span, e.text) for e in edits_there], old.source.offset)
        new = parse(new_text, path=changed)
        pairs = zip(old.source.tokens, new.source.tokens, strict=False)
        differing = sum(one != other for one, other in pairs)
        if len(old.source.tokens) != len(new.source.tokens) or differing != len(edits_there):
            return False
        after.open(Document(changed, new_text))
    if path not in by_path:
        after.open(Document(path, text_of(path)))
    return before == summary(after)


def summary(workspace: Workspace) -> list[tuple[str, str, int]]:
    """Return code, path and line of all findings."""
    return sorted(
        (d.code, d.span.path if d.span else "", d.span.line if d.span else 0)
        for found in all_findings(workspace).values()
        for d in found
    )


# -- requests ------------------------------------------------------------------------------------


def places(workspace: Workspace, path: str) -> Iterator[tuple[int, int]]:
    """Yield the place of every 50th token."""
    for view in workspace.views(path)[:1]:
        for start in view.source.starts[::50]:
            yield view.source.position(start)


def of_module(workspace: Workspace, view: View, path: str) -> dict[str, Callable[[], object]]:
    """Return the requests about a whole module, by name."""
    return {
        "outline": lambda: outline.outline(view),
        "folds": lambda: outline.folds(view.module.tree),
        "links": lambda: outline.links(view),
        "lenses": lambda: outline.lenses(view),
        "tokens": lambda: tokens.semantic_tokens(view),
        "hints": lambda: tokens.inlay_hints(view, (1, 10**6)),
        "fixes": lambda: formatting.safe_fixes(workspace.findings_of(path)),
    }


def of_place(
    workspace: Workspace, view: View, path: str, at: tuple[int, int]
) -> dict[str, Callable[[], object]]:
    """Return the requests about a place, by name."""
    return {
        "hover": lambda: hover.hover(view, *at),
        "definition": lambda: navigation.definitions(workspace, path, *at),
        "type": lambda: navigation.type_definitions(workspace, path, *at),
        "implementation": lambda: navigation.implementations(workspace, path, *at),
        "references": lambda: navigation.references(workspace, path, *at, declarations=True),
        "completion": lambda: completion.complete(view, *at),
        "signature": lambda: completion.signature_help(view, *at),
        "selection": lambda: outline.selections(view.module.tree, *at),
        "line": lambda: formatting.format_line(view, at[0]),
    }


def requests(files: list[str], chance: random.Random, seconds: float) -> int:
    """Ask everything everywhere; an exception ends the trial."""
    completion.prepare()
    end = time.process_time() + seconds
    count = 0
    worst = (0.0, "", "")
    while time.process_time() < end:
        path = chance.choice(files)
        text = text_of(path)
        if chance.random() < 0.5:
            text = text[: chance.randint(0, len(text))]
        workspace = opened(path, text)
        for view in workspace.views(path)[:1]:
            for name, ask in of_module(workspace, view, path).items():
                worst = max(worst, timed(name, path, ask))
                count += 1
            for at in places(workspace, path):
                for name, ask in of_place(workspace, view, path, at).items():
                    worst = max(worst, timed(name, path, ask))
                    count += 1
                if time.process_time() > end:
                    break
    print(f"requests: {count}, the slowest {worst[1]} took {1e3 * worst[0]:.0f} ms: {worst[2]}")
    return 0


def timed(name: str, path: str, ask: Callable[[], object]) -> tuple[float, str, str]:
    """Return the CPU time of a request, with its name and file."""
    start = time.process_time()
    ask()
    return time.process_time() - start, name, path


if __name__ == "__main__":
    sys.exit(main())
