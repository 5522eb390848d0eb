-- What was done with tools; lissom run does it again.
return (require("lissom").replay{
    version = 1,
    open = { "parts.lua" },
    before = "0258978fb2483b97",
    events = {
        { "look", { eye = { 0, 0, 5 }, fov = 29.999999999999996, size = { 1280, 960 }, target = { 0, 0, 0 }, up = { 0, 1, 0 } }, t = 0 },
        { "tool", "merge", t = 0.001 },
        { "look", { eye = { 1.777221202555133, 1.863998962963676, 3.505679936156254 }, fov = 29.999999999999996, size = { 990, 682 }, target = { -0.6064801396394066, 0.35139091117785887, 0.10140161563261867 }, up = { -0.19617469496901108, 0.9396926207859083, -0.2801664995932355 } }, t = 0.001 },
        { "press", 275, 250, t = 0.78 },
        { "release", 275, 250, t = 0.781 },
        { "press", 590, 411, t = 1.737 },
        { "release", 590, 411, hash = "b834104624c48757", objects = { { "merged", "7946818c6bb4aae0" } }, t = 1.737 },
        { "press", 236, 224, t = 2.692 },
        { "release", 236, 224, t = 2.693 },
        { "press", 572, 410, t = 3.244 },
        { "release", 572, 410, hash = "554642e9f9ee67d0", objects = { { "merged", "f891549c4ba028fe" } }, t = 3.245 },
        { "key", "enter", hash = "d52fea3a7dc855bc", t = 4.156 },
    },
    after = "d52fea3a7dc855bc",
})
