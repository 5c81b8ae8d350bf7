"""The adapter on stdio, as a file for clients that start `PYTHON FILE`."""

from rapidgen.cli.app import run

if __name__ == "__main__":
    run(["dap"])
