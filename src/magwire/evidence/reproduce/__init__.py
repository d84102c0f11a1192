"""The paper's Results, figure by figure and claim by claim (``magwire reproduce``)."""
