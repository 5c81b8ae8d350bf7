"""Built-in routines, types and data of RAPID, as headers in its syntax."""
