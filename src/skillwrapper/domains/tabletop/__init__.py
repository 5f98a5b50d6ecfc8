"""Arms at a table in MuJoCo: what all domains with simulated arms share.

The table's top is the plane z = 0, x points away from the robot, lengths are metres. From below::

    extra       MuJoCo itself, imported late; what to install where it is missing
    poses       ``Pose``: position and rotation; compose with ``@``
    cameras     ``Camera``: where one stands, and where a point is seen; needs no MuJoCo
    robot_models  models of arms and grippers from the robosuite wheel, reduced, in the user's cache
    shapes      meshes of our own: ``lathe``, ``sweep``, ``add_mesh``, ``add_ring``
    stage       ``new_stage``: an MjSpec with floor, table, light; ``add_camera``, ``add_object``
    arms        ``ArmKind`` (``PANDA``, ``IIWA``), ``add_arm``, ``weld`` (grasps in physics)
    welds       what a hand holds and what sticks to something, for forces
    kinematics  ``Arm``: the joints of one arm in a compiled model, inverse kinematics
    world       ``TableWorld``: model and data, where things are, who holds what, what is shown
    collisions  ``Clearance``: whether arms and what they hold touch anything else
    motion      ``Motion``: moving along paths that are free, grasping, releasing;
                ``KinematicMotion`` does it at once, ``MotionFailed`` says why it cannot
    physics     ``PhysicsMotion``: the same by forces, with what goes wrong
    photos      ``Photographer``: pictures of a world

A domain builds a stage, adds arms and objects, compiles it and writes its skills over ``Motion``::

    stage = new_stage(cameras={"front": Camera((1.3, 0, .8), (.4, 0, .1), 42)})
    add_arm(stage, PANDA, "arm")
    body = add_object(stage, "cup", mass=0.2)  # then body.add_geom(..., **VISIBLE or **SOLID)
    world = TableWorld(stage.compile(), [ArmSetup("arm", PANDA, home)])
    motion = KinematicMotion(world)
    world.put("cup", Pose.at(.5, .1, 0))
    motion.move_to("arm", above); motion.move_to("arm", grip, touching={"cup"})
    motion.grasp("arm", "cup", opening=.03); motion.go_home("arm")
    pixels = Photographer(640, 480).take(world, "front")
"""
