"""The sample records: by name, from Python and from the command."""

import json

import pytest
import stickslip as ss
from stickslip import cli


def test_the_sample_records_are_those_of_the_files(pyslammer_files):
    records = ss.sample_records()
    assert list(records) == [ss.read_record(file) for file in pyslammer_files]
    assert len(records) == 18


def test_a_sample_record_goes_by_a_part_of_its_name(pyslammer_files):
    kobe = ss.sample_record("Kobe")
    assert "Kobe" in kobe.name
    assert kobe == ss.sample_record("kobe_1995_TAK-090") == ss.sample_record("kobe 1995")
    assert kobe in ss.sample_records()


@pytest.mark.parametrize(
    ("name", "message"),
    [
        (
            "Northridge",
            "'Northridge' matches several .*: Northridge_1994_PAC-175, Northridge_1994_V",
        ),
        ("Tokyo", "'Tokyo' matches none of the sample records: Cape_Mendocino"),
        ("", "'' matches several"),
    ],
)
def test_a_name_that_is_not_of_one_record_is_refused(pyslammer_files, name, message):
    with pytest.raises(ValueError, match=message):
        ss.sample_record(name)


def test_the_command_slides_a_sample_record(pyslammer_files, capsys):
    assert cli.main(["slide", "sample:Kobe", "--mu", "0.1", "--json"]) == 0
    row = json.loads(capsys.readouterr().out)["results"][0]
    r = ss.integrate(ss.Coulomb(mu=0.1), ss.sample_record("Kobe"), settle=True)
    assert row["record"] == "Kobe, Japan 1995 - TAK-090"
    assert r.peak in row.values() and r.residual in row.values()
    assert cli.main(["slide", "sample:Tokyo", "sample:Kobe", "--mu", "0.1"]) == 1
    seen = capsys.readouterr()
    assert "sample:Tokyo: sample_record: 'Tokyo' matches none" in seen.err
    assert "TAK-090" in seen.out


def test_without_the_package_that_has_them_the_message_names_it(monkeypatch):
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    with pytest.raises(ImportError, match=r"pip install stickslip\[records\]"):
        ss.sample_records()
