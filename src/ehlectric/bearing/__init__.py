"""A whole rolling bearing: loads of its elements, films of its contacts, and its electrical circuit."""
