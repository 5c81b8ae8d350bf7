"""Execution of RAPID: values, errors, compiler, tasks, built-ins."""
