"""mpm_report: a page of pictures and figures of one run."""
