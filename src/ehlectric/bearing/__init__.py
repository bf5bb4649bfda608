"""Rolling bearings: loads of the elements, films of the contacts, and the electrical circuit."""
