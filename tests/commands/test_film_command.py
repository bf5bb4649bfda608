"""The film command, as a user types it."""

import json

import pytest


def test_film_of_groups(ehlectric):
    done = ehlectric("film", "--m", "50", "--l", "10")
    assert (done.returncode, done.stderr) == (0, "")
    assert "central film" in done.stdout
    assert "±" in done.stdout


def test_film_of_a_contact(ehlectric):
    contact = ("--radius", "8 mm", "--modulus", "226 GPa", "--load", "100 kN/m", "--speed", "4 m/s")
    done = ehlectric("film", "--oil", "fva-3", "--temperature", "70 degC", *contact, "--json")
    assert done.returncode == 0, done.stderr
    numbers = json.loads(done.stdout)
    assert numbers["ratio"] is None
    # Solved on 3201 nodes: 0.507 um.
    assert numbers["central_thickness"] == pytest.approx(0.507e-6, rel=0.01)
