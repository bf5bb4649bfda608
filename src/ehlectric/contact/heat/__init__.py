"""Heat and shear of the film of a contact: input of the solver; numbers, files and warnings of results."""
