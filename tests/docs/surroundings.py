"""What commands of the tests find around them: Kerf's programs, stand-ins for Slurm and ssh, Open MPI as it has to be
where several hosts are one machine."""

import os


def environment(source, build, folder, **more):
    """Without a display. `folder`: for temporary files."""
    foreign = ("SLURM_", "OMPI_", "PMI")  # of a job that the tests run in
    kept = {k: v for k, v in os.environ.items()
            if k not in ("DISPLAY", "WAYLAND_DISPLAY") and not k.startswith(foreign)}
    stand_ins = f"{source}/tests/docs/stand_ins"
    return kept | {
        "PATH": f"{build}:{stand_ins}:{os.environ['PATH']}",
        "TMPDIR": str(folder),
        "OMPI_ALLOW_RUN_AS_ROOT": "1",
        "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
        "OMPI_MCA_rmaps_base_oversubscribe": "1",
        "OMPI_MCA_mpi_yield_when_idle": "1",
        "OMPI_MCA_btl": "self,tcp",  # in shared memory, ranks of different hosts would take each other's places
        "OMPI_MCA_btl_tcp_if_include": "lo",  # also where there is no network
        "OMPI_MCA_oob_tcp_if_include": "lo",
        "OMPI_MCA_plm_rsh_agent": f"{stand_ins}/ssh",
        "KERF_NODES": "2",
        "KERF_CPUS_PER_TASK": "1",
    } | more
