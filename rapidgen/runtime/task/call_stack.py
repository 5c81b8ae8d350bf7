"""Who is where: call stacks of tasks as places in RAPID."""

from collections.abc import Iterator, Sequence
from types import CodeType, FrameType, TracebackType

from rapidgen.runtime.compiler.code_info import CodeRole, Codes
from rapidgen.runtime.errors import Location


def outwards(frame: FrameType | None) -> Iterator[FrameType]:
    """A frame and its callers."""
    while frame is not None:
        yield frame
        frame = frame.f_back


def frames_of(traceback: TracebackType | None) -> Iterator[tuple[FrameType, int]]:
    """Frames and lines of a traceback, outermost first."""
    while traceback is not None:
        yield traceback.tb_frame, traceback.tb_lineno
        traceback = traceback.tb_next


def location(codes: Codes, file: str, line: int) -> Location | None:
    """RAPID place of a Python line."""
    compiled = codes.get(file)
    if compiled is None or not 0 <= line < len(compiled.tokens):
        return None
    module = compiled.module
    token = compiled.tokens[line]
    span = module.tree.source.span(token, token)
    origin = None
    for rapid_line, template, template_line in module.file.origin:
        if rapid_line > span.line:
            break
        origin = (template, template_line + span.line - rapid_line)
    return Location(module.name, compiled.routine.name, span, origin)


def between(codes: Codes, frame: FrameType | None, outside: Sequence[CodeType]) -> bool:
    """Whether the innermost routine is between two statements: it calls one of `outside`."""
    called: CodeType | None = None
    for at in outwards(frame):
        if at.f_code.co_filename in codes:
            return any(called is code for code in outside)
        called = at.f_code
    return False


def stack_of_error(codes: Codes, error: BaseException) -> tuple[Location, ...]:
    """Where an error was raised, outermost routine first."""
    result: list[Location] = []
    for frame, line in frames_of(error.__traceback__):
        place = location(codes, frame.f_code.co_filename, line)
        if place is not None:
            if _is_part(codes, frame):
                result.pop()
            result.append(place)
    return tuple(result)


def stack_at(codes: Codes, frame: FrameType | None) -> tuple[Location, ...]:
    """Call stack of a frame, outermost routine first."""
    result: list[Location] = []
    inside = False
    for at in outwards(frame):
        place = location(codes, at.f_code.co_filename, at.f_lineno)
        if place is not None:
            if not inside:
                result.append(place)
            inside = _is_part(codes, at)
    return tuple(reversed(result))


def _is_part(codes: Codes, frame: FrameType) -> bool:
    return codes[frame.f_code.co_filename].role(frame.f_code) is CodeRole.PART
