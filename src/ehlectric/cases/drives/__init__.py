"""What a drive file may say: source, circuit, bearings and breakdown."""
