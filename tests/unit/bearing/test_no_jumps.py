"""Numbers of every kind of bearing along every one of its numeric inputs: none jumps."""
