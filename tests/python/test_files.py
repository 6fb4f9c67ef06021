"""Files that are written: whole, where a link leads, as they were; or not at all."""

import errno
import os
import shutil
import signal
import socket
import stat
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
import stickslip as ss
from sources import BLOCK, SHAKING, same_bits, waiting_for

MEMBERS = 200
IS_ROOT = hasattr(os, "geteuid") and os.geteuid() == 0
needs_root = pytest.mark.skipif(not IS_ROOT, reason="only root can make devices and mount")


def save_picture(file):
    pytest.importorskip("matplotlib", reason="pictures need matplotlib")
    from stickslip import plotting

    plotting.save(ss.integrate(BLOCK, ss.GroundMotion([1, -4, 3], dt=0.1)).plot(), file)


def run(file=None, **more):
    return ss.run_ensemble(BLOCK, SHAKING, members=MEMBERS, seed=1, checkpoint=file, **more)


WRITERS = {
    "ensemble": lambda file: run().save(file),
    "checkpoint": run,
    "picture": save_picture,
}


@pytest.fixture(params=WRITERS)
def write(request):
    return WRITERS[request.param]


@pytest.fixture
def ends():
    """What reads or writes a FIFO may wait for ever."""
    signal.signal(signal.SIGALRM, lambda *_: pytest.fail("hangs"))
    signal.alarm(60)
    yield
    signal.alarm(0)


# ---- links, modes, owners


def test_a_link_is_followed_and_stays(write, tmp_path):
    far, near = tmp_path / "far", tmp_path / "near"
    far.mkdir()
    near.mkdir()
    target, middle, link = far / "target.svg", far / "middle.svg", near / "link.svg"
    middle.symlink_to("target.svg")
    link.symlink_to("../far/middle.svg")
    for _ in ("dangling", "of a file"):
        write(link)
        assert os.readlink(link) == "../far/middle.svg"
        assert os.readlink(middle) == "target.svg"
        assert target.is_file() and not target.is_symlink()
        assert target.stat().st_size > 1000
        assert sorted(tmp_path.rglob("*")) == sorted([far, near, target, middle, link])
        target.chmod(0o600)
    assert stat.S_IMODE(target.stat().st_mode) == 0o600


def test_a_link_that_leads_nowhere_is_refused(write, tmp_path):
    link = tmp_path / "link.svg"
    link.symlink_to(link)
    with pytest.raises(OSError) as refusal:
        write(link)
    assert refusal.value.errno == errno.ELOOP
    link.unlink()
    link.symlink_to(tmp_path / "missing" / "a.svg")
    with pytest.raises(FileNotFoundError, match=r"no such folder: .*missing"):
        write(link)


@pytest.mark.parametrize("mode", [0o644, 0o600, 0o660, 0o777])
def test_a_file_keeps_its_mode(write, mode, tmp_path):
    file = tmp_path / "a.svg"
    write(file)
    mask = os.umask(0)
    os.umask(mask)
    assert stat.S_IMODE(file.stat().st_mode) == 0o666 & ~mask
    file.chmod(mode)
    before = file.stat()
    write(file)
    after = file.stat()
    assert after.st_ino != before.st_ino
    assert (after.st_mode, after.st_uid, after.st_gid) == (
        before.st_mode,
        before.st_uid,
        before.st_gid,
    )


@pytest.fixture
def as_user():
    """A folder of a user other than root, who runs the test."""
    folder = Path(tempfile.mkdtemp())
    if IS_ROOT:
        os.chown(folder, 65534, 65534)
        os.setegid(65534)
        os.seteuid(65534)
    yield folder
    if IS_ROOT:
        os.seteuid(0)
        os.setegid(0)
    shutil.rmtree(folder)


def test_a_file_that_is_read_only_is_refused(write, as_user):
    file = as_user / "a.svg"
    write(file)
    before = file.read_bytes()
    file.chmod(0o400)
    with pytest.raises(PermissionError, match=r"must be writable, is read-only: .*a\.svg"):
        write(file)
    assert file.read_bytes() == before
    assert stat.S_IMODE(file.stat().st_mode) == 0o400
    assert list(as_user.iterdir()) == [file]


def test_a_folder_that_is_read_only_is_named(write, as_user):
    as_user.chmod(0o500)
    with pytest.raises(PermissionError) as refusal:
        write(as_user / "a.svg")
    assert refusal.value.filename == str(as_user)


@needs_root
def test_root_leaves_a_file_to_its_owner(write, tmp_path):
    file = tmp_path / "a.svg"
    write(file)
    os.chown(file, 65534, 65533)
    file.chmod(0o400)
    write(file)
    after = file.stat()
    assert (after.st_uid, after.st_gid, stat.S_IMODE(after.st_mode)) == (65534, 65533, 0o400)


# ---- what is no file


def make_fifo(path):
    os.mkfifo(path)


def make_socket(path):
    with socket.socket(socket.AF_UNIX) as end:
        end.bind(path.name)  # a whole path may be too long


def make_device(path):
    try:
        os.mknod(path, stat.S_IFCHR | 0o666, os.makedev(1, 3))  # as /dev/null
    except PermissionError:
        pytest.skip("only root can make devices")


OTHERS = {
    "a FIFO": make_fifo,
    "a socket": make_socket,
    "a device": make_device,
    "a folder": Path.mkdir,
}


@pytest.mark.parametrize("kind", OTHERS)
def test_what_is_no_regular_file_is_refused_and_stays(write, kind, tmp_path, monkeypatch, ends):
    monkeypatch.chdir(tmp_path)
    path, link = tmp_path / "a.svg", tmp_path / "link.svg"
    OTHERS[kind](path)
    link.symlink_to(path)
    before = path.stat()
    for name in (path, link):
        with pytest.raises(OSError, match=f"must be a regular file, got {kind}: .*{name.name}"):
            write(name)
        with pytest.raises(OSError, match=f"must be a regular file, got {kind}: .*{name.name}"):
            ss.Ensemble.load(name)
    after = path.stat()
    assert (after.st_ino, after.st_mode, after.st_rdev) == (
        before.st_ino,
        before.st_mode,
        before.st_rdev,
    )
    assert link.is_symlink()
    assert sorted(tmp_path.iterdir()) == [path, link]


# ---- full disks


def mounted(folder):
    """A file system of two pages; None where it is not permitted."""
    folder.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=8k", "none", str(folder)]
    try:
        return subprocess.run(mount, capture_output=True).returncode == 0
    except FileNotFoundError:
        return False


@pytest.fixture(params=["a full file system", "a disk that says so"])
def full(request, tmp_path, monkeypatch):
    """A folder where nothing can be written."""
    folder = tmp_path / "full"
    if request.param == "a full file system":
        if not mounted(folder):
            pytest.skip("a full file system can only be mounted by root")
        yield folder
        subprocess.run(["umount", str(folder)], check=True)
    else:
        folder.mkdir()

        def refuse(descriptor):
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

        monkeypatch.setattr(os, "fsync", refuse)
        yield folder


def test_a_full_disk_is_said_and_leaves_what_was_there(write, full):
    file = full / "a.svg"
    if write is run:
        with pytest.raises(ss.EnsembleError, match=r"No space left on device: .*a\.svg") as failure:
            run(file)
        assert failure.value.__cause__.errno == errno.ENOSPC
    else:
        file.write_bytes(b"what was there")
        with pytest.raises(OSError, match=r"No space left on device: .*a\.svg"):
            write(file)
        assert file.read_bytes() == b"what was there"
        file.unlink()
    assert list(full.iterdir()) == []


@pytest.mark.parametrize("where", ["here", "in an executor"])
def test_a_run_on_a_full_disk_goes_on_and_loses_nothing(where, full):
    file = full / "run.npz"
    with ThreadPoolExecutor(2) as pool:
        more = {} if where == "here" else {"executor": pool}
        with (
            pytest.warns(RuntimeWarning, match=r"cannot write checkpoint .*No space left") as said,
            pytest.raises(
                ss.EnsembleError, match=r"No space left .*has the 200 members"
            ) as failure,
        ):
            run(file, checkpoint_every=0, progress=lambda done, total: None, **more)
    assert len(said) == 1
    assert len(failure.value.members) == 0
    assert failure.value.__cause__.errno == errno.ENOSPC
    assert same_bits(failure.value.partial, run())
    assert list(full.iterdir()) == []


def test_a_run_that_is_broken_off_on_a_full_disk_loses_nothing(full):
    def stop(done, total):
        if done == total:
            raise LookupError("enough")

    with pytest.raises(ss.EnsembleError, match="No space left") as failure:
        run(full / "run.npz", progress=stop)
    assert same_bits(failure.value.partial, run())


def test_a_disk_that_is_full_for_a_while_costs_nothing(tmp_path, monkeypatch):
    def refuse_once(descriptor):
        tried.append(descriptor)
        if len(tried) == 1:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(os, "fsync", refuse_once)
    file = tmp_path / "run.npz"
    tried = []
    with pytest.warns(RuntimeWarning, match="the run continues and retries every 0 s"):
        whole = run(file, checkpoint_every=0)
    assert len(tried) > 1
    assert same_bits(ss.Ensemble.load(file), whole)
    assert list(tmp_path.iterdir()) == [file]


# ---- processes that are killed

WRITING = """
import sys, time
from pathlib import Path
from stickslip._files import replacing
with replacing(Path(sys.argv[1])) as stream:
    stream.write(b"half of it")
    stream.flush()
    print("writing", flush=True)
    time.sleep(3600)
"""


def test_what_a_killed_process_leaves_is_removed_and_what_a_live_one_writes_is_not(write, tmp_path):
    file = tmp_path / "a.svg"
    command = [sys.executable, "-c", WRITING, str(tmp_path / "another")]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as child:
        try:
            assert child.stdout.readline() == "writing\n"
            (half,) = tmp_path.iterdir()
            write(file)
            assert half.read_bytes() == b"half of it"
        finally:
            child.kill()
    assert set(tmp_path.iterdir()) == {half, file}
    write(file)
    assert list(tmp_path.iterdir()) == [file]


def test_a_run_that_is_killed_while_it_saves_leaves_a_whole_checkpoint(tmp_path):
    script = """
import sys, stickslip as ss
from sources import BLOCK, SHAKING
ss.run_ensemble(BLOCK, SHAKING, members=10**9, seed=1, checkpoint=sys.argv[1], checkpoint_every=0)
"""
    file = tmp_path / "run.npz"
    paths = os.pathsep.join([str(Path(__file__).parent), *sys.path])
    command = [sys.executable, "-c", script, str(file)]
    seen = []
    for _ in range(3):
        with subprocess.Popen(command, env=os.environ | {"PYTHONPATH": paths}) as child:
            try:
                waiting_for(lambda: file.exists() and file.stat().st_ino not in seen, child)
                seen.append(file.stat().st_ino)
            finally:
                child.kill()
        assert ss.Ensemble.load(file).members % 64 == 0
    ss.Ensemble.load(file).save(file)
    assert list(tmp_path.iterdir()) == [file]
