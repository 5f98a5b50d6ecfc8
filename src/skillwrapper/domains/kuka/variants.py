"""The two arms' table with other things, light, cameras and forces: the domain's drawings."""

from __future__ import annotations

from skillwrapper.domains.kuka.cameras import HIGH, OPPOSITE
from skillwrapper.domains.kuka.environment import KukaEnvironment
from skillwrapper.domains.kuka.objects import OTHERS
from skillwrapper.domains.kuka.physical import PhysicalKukaEnvironment
from skillwrapper.domains.kuka.table import Setting
from skillwrapper.domains.tabletop.physics import CLUMSINESS
from skillwrapper.domains.tabletop.stage import Lighting
from skillwrapper.world.domain import Domain


def other_things(domain: Domain) -> KukaEnvironment:
    """Another jar, knife, holder and bread."""
    return KukaEnvironment(Setting(look=OTHERS), domain=domain)


def from_above(domain: Domain) -> KukaEnvironment:
    """Seen from higher up, a little from the left."""
    return KukaEnvironment(camera=HIGH, domain=domain)


def from_opposite(domain: Domain) -> KukaEnvironment:
    """Seen from the other side of the table."""
    return KukaEnvironment(camera=OPPOSITE, domain=domain)


def in_dim_light(domain: Domain) -> KukaEnvironment:
    """With about half of the light."""
    return _lit(Lighting(strength=0.55), domain)


def in_bright_light(domain: Domain) -> KukaEnvironment:
    """With nearly half as much light again."""
    return _lit(Lighting(strength=1.4), domain)


def in_warm_light(domain: Domain) -> KukaEnvironment:
    """As in the evening."""
    return _lit(Lighting(warmth=1.0), domain)


def with_shadows(domain: Domain) -> KukaEnvironment:
    """With a lamp that casts shadows."""
    return _lit(Lighting(shadows=True), domain)


def by_forces(domain: Domain) -> PhysicalKukaEnvironment:
    """Moved by servos that do what they should."""
    return PhysicalKukaEnvironment(domain=domain)


def clumsy(domain: Domain) -> PhysicalKukaEnvironment:
    """Moved by servos, with poses seen wrongly and things that slip."""
    return PhysicalKukaEnvironment(CLUMSINESS, domain=domain)


def _lit(lighting: Lighting, domain: Domain) -> KukaEnvironment:
    return KukaEnvironment(Setting(lighting=lighting), domain=domain)
