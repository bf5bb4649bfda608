"""
A sweep and its map
===================

A sweep solves one case for many values of its inputs. Here the entrainment speed and the load of a line
contact vary: 4 x 4 points.
"""

from tempfile import TemporaryDirectory

import ehlectric

sweep = ehlectric.Sweep.from_dict(
    {
        "title": "A line contact over speed and load",
        "case": ehlectric.example("discharge"),
        "vary": {
            "contact.entrainment_speed": {"from": "0.5 m/s", "to": "4 m/s", "count": 4, "spacing": "log"},
            "contact.load_per_length": {"from": "0.8 MN/m", "to": "2 MN/m", "count": 4, "spacing": "log"},
        },
    }
)

# %%
# The points are solved in processes, one for each core. The map shows the breakdown voltage: it depends
# on the speed far more than on the load.
with TemporaryDirectory() as folder:
    results = ehlectric.run_sweep(sweep, folder)
print(results)
results.plot(x="contact.entrainment_speed", y="contact.load_per_length")
