"""Run all benchmarks: ``python -m benchmarks``."""

from __future__ import annotations

from benchmarks import calls, decoding, learning, memory, planning, render


def main() -> None:
    """Print what each of them measures."""
    for benchmark in (render, learning, decoding, memory, planning, calls):
        print(f"\n== {benchmark.__name__.rpartition('.')[2]}", flush=True)
        benchmark.main()


if __name__ == "__main__":
    main()
