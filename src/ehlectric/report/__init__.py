"""Report of a result: its inputs, figures, warnings, versions, sources and assumptions, as HTML and PDF."""
