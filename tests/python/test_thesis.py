"""The thesis's figures from Python: pictures, files, the command."""

import numpy as np
import pytest
from stickslip import cli
from stickslip.thesis import Thesis, file_stem, page, plot


def test_every_figure_has_a_name_of_its_own():
    stems = {file_stem(number) for number in Thesis.numbers}
    assert len(stems) == len(Thesis.numbers) == 27
    assert {"figure_2_1", "figure_a_2", "table_5_1", "section_5_6"} <= stems


@pytest.mark.parametrize(
    "number", [pytest.param(n, marks=[pytest.mark.slow] * (n == "5.7")) for n in Thesis.numbers]
)
def test_the_numbers_of_a_figure_are_the_expected_ones(number):
    """With few members, for which the allowed differences are larger; with all: script/docs."""
    checks = Thesis(members=200).figure(number).check()
    assert checks
    assert not [check.what for check in checks if not check.holds]


def test_a_picture_has_the_panels_and_says_what_is_seen():
    matplotlib = pytest.importorskip("matplotlib")
    figure = Thesis(members=200).figure("4.5")
    picture = plot(figure)
    assert isinstance(picture, matplotlib.figure.Figure)
    assert [axes.get_ylabel() for axes in picture.axes] == [panel.y for panel in figure.panels]
    assert picture.axes[1].get_yscale() == "log"
    said = " ".join(text.get_text() for text in picture.texts).replace("\n", " ")
    assert figure.caption in said


def test_curves_are_arrays_that_cannot_be_written_to():
    curve = Thesis().figure("2.1").panels[0].curves[0]
    # (2.24) at omega = 0.25 with B/a = 1.3.
    assert curve.y[0] == pytest.approx(np.sqrt(1.3**2 - (4 / np.pi) ** 2) / 0.25**2, rel=1e-12)
    with pytest.raises(ValueError, match="read-only"):
        curve.y[0] = 1


def test_an_unknown_figure_is_refused():
    with pytest.raises(ValueError, match=r"must be one of 2\.1, .*, A\.2, got 1\.1"):
        Thesis().figure("1.1")


def test_what_the_progress_callback_raises_ends_the_work():
    def progress(task, fraction):
        assert 0 <= fraction <= 1
        raise RuntimeError(task)

    with pytest.raises(RuntimeError, match=r"4\.4"):
        Thesis(members=500, progress=progress).figure("4.4")


def test_a_page_shows_every_statement():
    figure = Thesis().figure("A.2")
    text = page([figure], ".png")
    assert "![Figure A.2](./figure_a_2.png)" in text
    for statement in figure.statements:
        assert statement.claim in text
    assert text.count("**differs**") == sum(not s.agrees for s in figure.statements) > 0


def test_what_this_library_says_stands_in_a_table_of_its_own():
    figure = Thesis(members=200).figure("2.5")
    ours = [s for s in figure.statements if not s.where]
    assert ours and len(ours) < len(figure.statements)
    thesis, here = page([figure], ".png").split("| | said here | found | |")
    assert "| | the thesis | found | |" in thesis
    for statement in figure.statements:
        claim = statement.claim.replace("|", r"\|")
        assert (claim in here) == (statement in ours) == (claim not in thesis)
    rows = [row.replace(r"\|", "") for row in (thesis + here).splitlines() if row.startswith("|")]
    assert {row.count("|") for row in rows} == {5}


def test_the_command_writes_pictures_numbers_and_a_page(tmp_path, capsys):
    pytest.importorskip("matplotlib")
    out = tmp_path / "new" / "folder"
    assert cli.main(["thesis", "A.2", "Table 5.1", "--members", "200", "--out", str(out)]) == 0
    assert sorted(file.name for file in out.iterdir()) == [
        "figure_a_2.csv",
        "figure_a_2.png",
        "gallery.md",
        "table_5_1.csv",
        "table_5_1.png",
    ]
    printed = capsys.readouterr().out
    assert "differs" in printed and "agrees" in printed and f"wrote 2 figures to {out}" in printed
    assert (out / "figure_a_2.png").read_bytes().startswith(b"\x89PNG")


def test_one_figure_is_one_figure(tmp_path, capsys):
    pytest.importorskip("matplotlib")
    assert cli.main(["thesis", "A.2", "--out", str(tmp_path)]) == 0
    printed = capsys.readouterr().out
    assert f"wrote 1 figure to {tmp_path}" in printed
    # A bound is read as a sentence: what the thesis states, then what is found here.
    assert ": at most 0.5 (thesis), " in printed and " here" in printed


@pytest.mark.slow
def test_reference_lines_come_last_in_a_legend():
    pytest.importorskip("matplotlib")
    figure = Thesis(members=100).figure("5.7")
    assert [curve.label for curve in figure.panels[0].curves][3] == "ground"  # drawn early
    legends = [axes.get_legend() for axes in plot(figure).axes]
    assert any(legends)  # one of both panels, if it is beside them
    for legend in filter(None, legends):
        labels = [text.get_text() for text in legend.get_texts()]
        assert labels[-1] == "ground" and labels.count("ground") == 1
        assert len(labels) == 5


@pytest.mark.parametrize("number", ["2.2", "5.4", pytest.param("5.7", marks=pytest.mark.slow)])
def test_a_legend_hides_no_curve(number):
    pytest.importorskip("matplotlib")
    picture = plot(Thesis(members=100).figure(number))
    picture.draw_without_rendering()
    assert any(axes.get_legend() for axes in picture.axes)
    for axes in picture.axes:
        if (legend := axes.get_legend()) is None:
            continue
        box = legend.get_window_extent()
        for line in axes.get_lines():
            x, y = (np.asarray(values, float) for values in line.get_data())
            if line.get_linestyle() != "None" and len(x) > 1:  # also between its points
                fine = np.linspace(0, len(x) - 1, 20 * len(x))
                x, y = (np.interp(fine, np.arange(len(v)), v) for v in (x, y))
            assert not box.count_contains(line.get_transform().transform(np.column_stack([x, y])))


def test_the_command_checks(capsys):
    assert cli.main(["thesis", "2.1", "A.2", "--check"]) == 0
    lines = capsys.readouterr().out.splitlines()
    texts = sum(" text " in line for line in lines[:-1])
    numbers = len(lines) - 1 - texts
    assert numbers > 20 and texts > 5 and all(line.startswith("holds") for line in lines[:-1])
    assert any("text 0: " in line and "|" in line for line in lines)
    assert lines[-1].startswith(
        f"2 figures, {numbers} numbers and {texts} texts checked, none skipped; "
    )
    assert lines[-1].endswith("; 0 off")


@pytest.mark.parametrize(
    "arguments, message",
    [
        (["2.1", "9.9"], "got 9.9"),
        (["2.1", "9.9", "--check"], "got 9.9"),
        (["2.1", "--members", "0"], "got 0"),
        (["2.1", "--seed", "-1"], "-1"),
        (["2.1", "--seed", str(2**64)], "--seed must be at most"),
        (["2.1", "--threads", "0"], "--threads must be at least 1, got 0"),
        (["2.1", "--threads", "-1"], "--threads must be at least 1, got -1"),
    ],
)
def test_the_command_refuses_before_it_begins_and_leaves_no_folder(
    tmp_path, capsys, monkeypatch, arguments, message
):
    monkeypatch.chdir(tmp_path)
    assert cli.main(["thesis", *arguments]) == 2
    captured = capsys.readouterr()
    assert captured.out == "" and message in captured.err and captured.err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []
