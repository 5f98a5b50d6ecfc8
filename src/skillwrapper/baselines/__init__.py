"""The methods that skillwrapper is compared with."""
