"""Tables of a bearing file: bearing with load and speed, discharge, motor, and the file as a whole."""
