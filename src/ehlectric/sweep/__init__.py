"""Many cases at once: design, execution, storage, tables and sensitivity of a sweep."""
