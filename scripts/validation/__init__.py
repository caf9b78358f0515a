"""Published numbers beside those of the program: one module a table, and the routes that the program does not take."""
