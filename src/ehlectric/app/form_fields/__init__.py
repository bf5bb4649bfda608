"""Fields of the forms as data, and the rules by which inputs that exclude each other take turns."""

from ehlectric.app.form_fields.bearing_fields import BEARING_GROUPS
from ehlectric.app.form_fields.field import Field, Group, Way

__all__ = ["BEARING_GROUPS", "Field", "Group", "Way"]
