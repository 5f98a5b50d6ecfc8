"""The burger kitchen: four ingredients, a stove, a cutting board and a robot."""
