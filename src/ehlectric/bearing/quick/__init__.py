"""Contacts of a bearing at once: from the atlas of films or by film formulas, without solving them."""
