"""What field comes next."""
