"""Film factors of a contact from its measured film thickness: solved or by formula over the speed."""
