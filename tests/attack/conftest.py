"""The counts of the attack, in the summary of a test run."""


def pytest_terminal_summary(terminalreporter):
    reports = [report for kind in ("passed", "failed") for report in terminalreporter.stats.get(kind, [])]
    lines = [
        text
        for report in reports
        for name, text in getattr(report, "user_properties", ())
        if name == "attack"
    ]
    if lines:
        terminalreporter.section("attack")
        terminalreporter.write_line("\n".join(sorted(lines)))
