"""A Franka Panda at a table with a mug, a teapot, a plate, a bowl and a sponge, in MuJoCo."""
