"""`python -m rapidgen`: the command without its folder in PATH."""

from rapidgen.cli.entry import run

if __name__ == "__main__":
    run()
