//! Documents with the keys that no scenario file has.

/// What the scenario files have not: other ways to write the same, each after a minimal scenario.
pub(crate) const OTHERS: [&str; 54] = [
    "[gravity]\ncentral = \"4e14 m^3/s^2\"\n[initial]\nposition = \"7e6, 0, 0 m\"\nvelocity = \"0, 7.5e3, 0 m/s\"\n\
     relative_to = \"orbit\"\nstate_of = \"centre_of_mass\"",
    "[gravity]\nuniform = \"0, 0, -9.81 m/s^2\"",
    "[initial.attitude]\nmrp = [0.1, 0.2, 0.3]",
    "[initial.attitude]\naxis = [0, 0, 1]\nangle = \"30 deg\"",
    "[initial.attitude]\nquaternion = [1, 0, 0, 0]\nscalar = \"first\"",
    "[initial.attitude]\neuler = \"1, 2, 3 deg\"\nsequence = \"ZYX\"\ndirection = \"N to B\"",
    "[device.mount]\nmatrix = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]",
    "[device.mount]\ndcm = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]",
    "[device.mount]\naxis = [0, 0, 1]\nangle = \"30 deg\"",
    "[device.mount]\neuler = \"1, 2, 3 deg\"\nsequence = \"ZYX\"\ndirection = \"hub to device\"",
    "[device.layout.pyramid]\ncount = 3\nhalf_angle = \"30 deg\"",
    "[device.layout.ring]\ncount = 3\nradius = \"30 cm\"",
    // A layout of each kind with bodies of its own, and keys of its second device.
    "[device.layout.ring]\ncount = 2\n[[device.member]]\nname = \"rw2\"\nimbalance_model = \"lumped\"\n\
     imbalance.static = \"1 g mm\"\nwheel.rate = \"1 rpm\"\n\
     [[device]]\nname = \"v\"\nkind = \"vscmg\"\nlayout.ring.count = 2\n\
     gimbal = { mass = \"1 kg\", inertia = \"1, 1, 1 g m^2\" }\nwheel = { mass = \"1 kg\", inertia = \"2, 1, 1 g m^2\" }\n\
     member = [{ name = \"v2\", gimbal = { rate = \"1 deg/s\" } }]\n\
     [[device]]\nname = \"d\"\nkind = \"dgvscmg\"\nlayout.ring.count = 2\n\
     outer_gimbal = { mass = \"1 kg\", inertia = \"1, 1, 1 g m^2\" }\n\
     inner_gimbal = { mass = \"1 kg\", inertia = \"1, 1, 1 g m^2\" }\nwheel = { mass = \"1 kg\", inertia = \"2, 1, 1 g m^2\" }\n\
     member = [{ name = \"d2\", outer_gimbal = { rate = \"1 deg/s\" } }]\n\
     [[device]]\nname = \"p\"\nkind = \"hinged_panel\"\nlayout.ring.count = 2\n\
     panel = { mass = \"1 kg\", inertia = \"1, 1, 1 g m^2\" }\nmember = [{ name = \"p2\", panel = { angle = \"1 deg\" } }]\n\
     [[device]]\nname = \"s\"\nkind = \"slosh_mass\"\nlayout.ring.count = 2\nslosh_mass = { mass = \"1 kg\" }\n\
     member = [{ name = \"s2\", slosh_mass = { displacement = \"1 cm\" } }]\n\
     [[device]]\nname = \"f\"\nkind = \"flexible_reaction_wheel\"\nlayout.ring.count = 2\n\
     wheel = { mass = \"1 kg\", inertia = \"2, 1, 1 g m^2\" }\nmember = [{ name = \"f2\", tilt_y = { angle = \"1 mrad\" } }]",
    "inertia_axes = { axis = [0, 0, 1], angle = \"30 deg\" }",
    "[device.wheel.inertia_axes]\neuler = \"1, 2, 3 deg\"\nsequence = \"ZYX\"\ndirection = \"body to axes\"",
    "[device.wheel.rate]\nsine = \"1 rad/s\"\nfrequency = \"2 Hz\"\nmean = \"0 rad/s\"",
    "[device.wheel.torque]\nconstant = \"1 mN m\"\nfrom = \"0 s\"\nto = \"1 s\"",
    "[device.wheel.torque]\nstep = \"1 mN m\"\nat = \"1 ms\"\nbefore = \"0 N m\"",
    "[device.wheel.torque]\nramp = \"0, 1 mN m\"\nfrom = \"0 s\"\nto = \"1 s\"",
    "[device.wheel.torque]\nsine = \"1 mN m\"\nfrequency = \"2 Hz\"\nmean = \"0 N m\"",
    "[device.wheel.torque]\nchirp = \"1 mN m\"\nfrequency = \"1, 2 Hz\"\nfrom = \"0 s\"\nto = \"1 s\"",
    "[device.wheel.torque]\ntimes = \"0, 1 s\"\nvalues = \"0, 1 mN m\"\ninterpolation = \"hold\"",
    "[device.wheel.torque]\ntable = \"no.csv\"\ncolumn = \"u\"\nunit = \"N m\"\ninterpolation = \"hold\"",
    "[[device]]\nname = \"other\"\ncopy_of = \"rw\"\nturned_180_about = \"x\"",
    "power_limit = \"30 W\"\nrate_limit = \"6000 rpm\"",
    "[[controller]]\nname = \"a\"\nrate = \"10 Hz\"\noffset = \"0 s\"\ndelay = \"1 ms\"\ndevices = [\"rw\"]\n\
     law = { kind = \"mrp_feedback\", attitude_gain = \"1 N m\", rate_gain = \"1, 2, 3 N m s\", gyroscopic = \"nothing\" }\n\
     reference = { kind = \"hold\", attitude = { mrp = [0, 0, 0] } }\n\
     allocation = { inverse = \"generalised\", lambda = 0.1, dither_frequency = \"1 rad/s\" }\nservo = { gain = \"1 1/s\" }\n\
     [[at]]\ntime = \"1 ms\"\njoint = \"rw.wheel\"\ncontrolled = true",
    "[[controller]]\nname = \"a\"\nrate = \"10 Hz\"\ndevices = \"rw\"\n\
     law = { kind = \"quaternion_feedback\", attitude_gain = \"1 N m\", rate_gain = \"1 N m s\" }\n\
     reference = { kind = \"slew\", turn = { axis = [0, 0, 1], angle = \"9 deg\" }, acceleration_limit = \"1 deg/s^2\" }\n\
     allocation = { keep_out = { file = \"no.csv\" } }",
    "[[controller]]\nname = \"a\"\nrate = \"10 Hz\"\nlaw = { kind = \"eigen_axis\", frequency = \"1 Hz\", damping_ratio = 0.7 }\n\
     reference = { kind = \"turning\", angular_velocity = \"0, 1, 0 deg/s\" }",
    "[[controller]]\nname = \"a\"\nrate = \"10 Hz\"\nlaw = { kind = \"rate_damping\", rate_gain = \"1 N m s\" }\n\
     reference = { kind = \"orbit\" }\n[gravity]\ncentral = \"4e14 m^3/s^2\"\n\
     [initial]\nposition = \"7e6, 0, 0 m\"\nvelocity = \"0, 7.5e3, 0 m/s\"",
    "[[controller]]\nname = \"a\"\nrate = \"10 Hz\"\nlaw = { kind = \"rate_damping\", rate_gain = \"1 N m s\" }\n\
     reference = { kind = \"table\", times = \"0, 1 s\", scalar = \"last\", quaternions = [[0, 0, 0, 1], [0, 0, 1, 9]], \
     angular_velocities = [\"0, 0, 0 deg/s\", \"0, 0, 1 deg/s\"] }\n\
     allocation = { keep_out = [\"9, 10 rpm\"], keep_out_gain = \"1 1/s\" }",
    "[[controller]]\nname = \"a\"\nrate = \"10 Hz\"\ndevices = \"g\"\nlaw = { kind = \"rate_damping\", rate_gain = \"1 N m s\" }\n\
     allocation = { preferred_angles = [\"45 deg\"], angle_gain = \"1 1/s\" }\n\
     [[device]]\nname = \"g\"\nkind = \"vscmg\"\ngimbal = { mass = \"1 kg\", inertia = \"1, 1, 1 g m^2\" }\n\
     wheel = { mass = \"1 kg\", inertia = \"2, 1, 1 g m^2\" }",
    "[[controller]]\nname = \"a\"\nrate = \"10 Hz\"\nlaw = { kind = \"program\", command = [\"none\"], time_limit = \"1 s\" }",
    "[[controller]]\nname = \"a\"\nrate = \"10 Hz\"\nlaw = { kind = \"rate_damping\", rate_gain = \"1 N m s\" }\n\
     estimator = { attitude_deviation = \"1 deg\", bias_deviation = \"1 deg/h\" }\n\
     dumping = { gain = \"0.01 1/s\", momentum = \"0, 0, 1 N m s\", torque_limit = \"1 mN m\" }\n\
     [controller.sensors]\nseed = 1\nencoder_quantum = \"1 arcsec\"\ntachometer_quantum = \"0.1 rpm\"\n\
     gyro = { output = \"integrating\", angle_random_walk = \"0.01 deg/sqrt(h)\", rate_random_walk = \"0.1 deg/h/sqrt(h)\", \
     bias = \"1, 0, 0 deg/h\", quantum = \"1 mas\" }\n\
     star_tracker = { mount = { euler = \"1, 2, 3 deg\", sequence = \"ZYX\", direction = \"hub to device\" }, noise = \"1, 1, 5 arcsec\", rate = \"2 Hz\", latency = \"1 ms\" }\n\
     accelerometer = { position = \"1, 2, 3 cm\", noise_density = \"20 um/s^2/sqrt(Hz)\", bias = \"1, 0, 0 mm/s^2\", quantum = \"1 um/s^2\" }\n\
     [[controller.filter]]\nkind = \"low_pass\"\nfrequency = \"2 Hz\"\ndamping_ratio = 0.7\n\
     [[controller.filter]]\nsignal = \"torque\"\nkind = \"notch\"\nfrequency = \"3 Hz\"\nzero_damping = 0.1\npole_damping = 0.5\n\
     [[controller.filter]]\nkind = \"first_order_low_pass\"\nfrequency = \"2 Hz\"\n\
     [[controller.filter]]\nkind = \"lead_lag\"\nzero = \"1 Hz\"\npole = \"2 Hz\"",
    "[[at]]\ntime = \"1 ms\"\njoint = \"rw.wheel\"\ntorque = \"1 mN m\"",
    "[[at]]\ntime = \"1 ms\"\njoint = \"tank.slosh_mass\"\nforce = \"1 mN\"\n\
     power_limit = \"30 W\"\nspeed_limit = \"1 m/s\"\n\
     [[device]]\nname = \"tank\"\nkind = \"slosh_mass\"\nslosh_mass = { mass = \"1 kg\" }",
    "[[at]]\ntime = \"1 ms\"\njoint = \"tank.slosh_mass\"\nforce = \"1 mN\"\n\
     [[device]]\nname = \"tank\"\nkind = \"slosh_mass\"\nslosh_mass = { mass = \"1 kg\" }",
    "[[device]]\nname = \"tank\"\nkind = \"slosh_mass\"\nslosh_mass = { mass = \"1 kg\", coulomb = \"1 mN\", \
     static_friction = \"2 mN\", stribeck_rate = \"1 mm/s\", quadratic_drag = \"3 N s^2/m^2\" }",
    "[[device]]\nname = \"tank\"\nkind = \"slosh_mass\"\n\
     slosh_mass = { mass = \"1 kg\", corner_frequency = \"0.5 Hz\", damping_ratio = 0.01 }",
    "[[platform]]\nname = \"iso\"\nmass = \"1 kg\"\ninertia = \"1, 1, 1 g m^2\"\n\
     mount = { axis = [0, 0, 1], angle = \"30 deg\" }\n[platform.coupled]\n\
     rest_turns = \"0, 0, 1 mrad\"\n\
     stiffness.slides = [\"1, 0, 0 N/m\", \"0, 1, 0 N/m\", \"0, 0, 1 N/m\"]\n\
     damping.turns = [\"1, 0, 0 N m s/rad\", \"0, 1, 0 N m s/rad\", \"0, 0, 1 N m s/rad\"]\n\
     [[platform.strut]]\nposition = \"0, 0, 1 cm\"\ndirection = [0, 0, 1]\n\
     length = \"1 cm\"\nstiffness = \"1 N/m\"",
    "[[platform]]\nname = \"iso\"\non = \"hub\"\nmass = \"1 kg\"\n\
     inertia = \"1, 1, 1 g m^2\"\nx_slide = { corner_frequency = \"9 Hz\" }\n\
     z_turn = { torque = \"1 mN m\" }\n\
     mount = { euler = \"1, 2, 3 deg\", sequence = \"ZYX\", direction = \"hub to device\" }",
    "[[platform]]\nname = \"upper\"\non = \"iso\"\nmass = \"1 kg\"\ninertia = \"1, 1, 1 g m^2\"\n\
     position = \"0, 0, 1 cm\"\n[[platform]]\nname = \"iso\"\nmass = \"1 kg\"\ninertia = \"1, 1, 1 g m^2\"",
    "[[point]]\nname = \"a\"\non = \"rw.wheel\"\nposition = \"0, 0, 1 cm\"",
    "[[wrench]]\non = \"hub\"\nforce = { x = \"1 N\" }\nmoment = { z = \"1 N m\" }",
    "[[source]]\nname = \"tones\"\non = \"hub\"\nwheel = \"rw.wheel\"\npoint = \"0, 0, 1 cm\"\n\
     seed = 1\nmount = { axis = [0, 0, 1], angle = \"30 deg\" }\n[[source.harmonic]]\nnumber = 2.5\n\
     radial_force = \"1 g mm\"\naxial_moment = \"1 g mm^2\"\nphase = { radial_force = \"30 deg\" }",
    "[[source]]\nname = \"listed\"\non = \"hub\"\nwheel = \"rw.wheel\"\nseed = 1\n\
     harmonics = { file = \"no.csv\", force_unit = \"g mm\", moment_unit = \"g mm^2\", phase_unit = \"deg\" }",
    "[[source]]\nname = \"turned\"\non = \"hub\"\n\
     mount = { euler = \"1, 2, 3 deg\", sequence = \"ZYX\", direction = \"hub to device\" }\n\
     record = { times = \"0, 1 s\", moment_x = \"0, 1 N m\", interpolation = \"linear\" }",
    "[[source]]\nname = \"noise\"\non = \"rw.wheel\"\naxes = \"parent\"\nspin_axis = \"z\"\nseed = 1\n\
     [source.broadband]\nfrequencies = \"1, 40 Hz\"\nband = \"2, 30 Hz\"\nperiod = \"2 s\"\n\
     force_x = \"1e-9 N^2/Hz\"\nforce_y = \"1e-9 N^2/Hz\"\nreference_rate = \"3000 rpm\"\n\
     [[source.broadband.coherent]]\nbetween = [\"force_x\", \"force_y\"]\ncoherence = 0.5\n\
     phase = \"90 deg\"",
    "[[source]]\nname = \"table\"\non = \"rw\"\nfundamental_removed = true\nmodes_removed = false\n\
     [source.record]\nfile = \"no.csv\"\ntime = \"t\"\ncolumns = { force_x = \"fx\" }\n\
     force_unit = \"mN\"\nmoment_unit = \"mN m\"\ninterpolation = \"cubic\"\nrepeats = true",
    "[structure]\ndamping = 0.01\nmodes = 1\nfrequency_limit = \"9 Hz\"\ncontains_devices = false\n\
     coordinates = 0.1\nrates = [0.1]\n[[structure.point]]\nname = \"camera\"\nnode = \"tip\"\n\
     [[structure.node]]\nname = \"tip\"\nposition = \"0, 0, 1 m\"\n\
     [[structure.mode]]\nfrequency = \"3 Hz\"\ndamping = 0.1\nlinear_momentum = [0, 0, 0]\n\
     angular_momentum = [0, 0, 0]\n[[structure.mode.shape]]\nnode = \"tip\"\n\
     translation = [0, 0, 1]\nrotation = [0, 1, 0]\n[[structure.mode]]\nfrequency = \"1 rad/s\"\n\
     residual = true",
    "[structure]\nfile = \"modes.npz\"\nmodes = 4\nresidual_flexibility = true\nresidual_damping = 0.1\n\
     [[platform]]\nname = \"iso\"\nnode = \"tip\"\nmass = \"1 kg\"\ninertia = \"1, 1, 1 kg m^2\"",
    "[[crossing]]\ncolumn = \"rw.spin\"\nvalue = \"3000 rpm\"",
    "[[requirement]]\nname = \"a\"\nquantity = \"omega\"\nstatistic = \"peak\"\nlimit = \"1 rad/s\"",
    "[[requirement]]\nname = \"a\"\nquantity = \"omega\"\nstatistic = \"pde\"\nwindow = \"10 ms\"\n\
     stability = \"20 ms\"\nlevel = 0.95\nlimit = \"1 rad/s\"",
    "[[requirement]]\nname = \"a\"\nmargin = \"gain\"\ncontroller = \"aocs\"\nleast = \"6 dB\"",
];
