"""A run as one page to read: what was learned, when, from which pictures, and at what price."""

from skillwrapper.report.page import ReportSettings, render_report, write_report

__all__ = ["ReportSettings", "render_report", "write_report"]
