"""Threads of BLAS while films and fields are solved."""

import subprocess
import sys

# Number of threads of each BLAS while a film is solved, after a bearing has used the BLAS of NumPy only.
CODE = """
import sys
from threadpoolctl import threadpool_info
from ehlectric.runtime.threads import one_blas_thread, quiet_solution
with one_blas_thread(of_scipy=False):
    assert "scipy.linalg" not in sys.modules
with quiet_solution():
    import scipy.linalg
    print(*(each["num_threads"] for each in threadpool_info() if each["user_api"] == "blas"))
"""


def test_a_solution_has_one_thread_of_each_blas():
    done = subprocess.run([sys.executable, "-c", CODE], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert {*done.stdout.split()} == {"1"}
