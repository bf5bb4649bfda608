"""Fields of the forms as data, and the rules by which inputs that exclude each other are exchanged."""

from ehlectric.app.form_fields.bearing_fields import BEARING_GROUPS
from ehlectric.app.form_fields.field import Alternative, Field, Group
from ehlectric.app.form_fields.gear_fields import GEAR_GROUPS

__all__ = ["BEARING_GROUPS", "GEAR_GROUPS", "Alternative", "Field", "Group"]
