"""Runs and experiments as pages to read: what was learned, from what, at what price, how good."""

from skillwrapper.report.experiment_page import render_experiment, write_experiment_report
from skillwrapper.report.page import ReportSettings, render_report, write_report

__all__ = [
    "ReportSettings",
    "render_experiment",
    "render_report",
    "write_experiment_report",
    "write_report",
]
