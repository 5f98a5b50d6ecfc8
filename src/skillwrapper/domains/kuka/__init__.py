"""Two KUKA iiwa arms that spread peanut butter on a slice of bread, in MuJoCo."""
