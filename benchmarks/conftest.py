"""What recorded times say of themselves: the machine without its name, and statistics without each round."""


def pytest_benchmark_update_machine_info(machine_info):
    machine_info.pop("node", None)


def pytest_benchmark_update_json(output_json):
    for one in output_json["benchmarks"]:
        one["stats"].pop("data", None)
