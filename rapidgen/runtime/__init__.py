"""RAPID while it runs: values, errors, compiler, tasks, built-ins."""
