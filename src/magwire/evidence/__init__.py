"""What magwire is judged by: its speed, the paper, answers from elsewhere, published curves."""
