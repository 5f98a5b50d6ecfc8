from pathlib import Path

import pytest

from skillwrapper.world import Domain, load_domain

BURGER = Path(__file__).parents[2] / "src/skillwrapper/domains/burger/domain.yaml"


@pytest.fixture(scope="session")
def burger() -> Domain:
    return load_domain(BURGER)
