"""Solution of all contacts of a bearing, and of the circuit that they form."""
