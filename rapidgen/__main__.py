"""`python -m rapidgen`: the command, where its folder is not on the PATH."""

from rapidgen.cli.entry import run

if __name__ == "__main__":
    run()
