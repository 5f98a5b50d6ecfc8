"""Learners of action models on AMLGym's domains, data and baselines (extra ``amlgym``)."""
