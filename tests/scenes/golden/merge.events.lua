-- What was done with tools; lissom run does it again.
return (require("lissom").replay{
    version = 1,
    open = { "parts.lua" },
    before = "0258978fb2483b97",
    events = {
        { "look", { eye = { 0, 0, 5 }, fov = 29.999999999999996, size = { 1280, 960 }, target = { 0, 0, 0 }, up = { 0, 1, 0 } }, t = 0 },
        { "tool", "merge", t = 0.001 },
        { "look", { eye = { 1.777221202555133, 1.863998962963676, 3.505679936156254 }, fov = 29.999999999999996, size = { 990, 682 }, target = { -0.6064801396394066, 0.35139091117785887, 0.10140161563261867 }, up = { -0.19617469496901108, 0.9396926207859083, -0.2801664995932355 } }, t = 0.002 },
        { "press", 275, 250, t = 4.961 },
        { "release", 275, 250, t = 4.962 },
        { "press", 590, 411, t = 9.206 },
        { "release", 590, 411, hash = "b834104624c48757", t = 9.206 },
        { "press", 236, 224, t = 14.681 },
        { "release", 236, 224, t = 14.687 },
        { "press", 572, 410, t = 16.816 },
        { "release", 572, 410, hash = "554642e9f9ee67d0", t = 16.819 },
        { "key", "enter", hash = "d52fea3a7dc855bc", t = 20.358 },
    },
    after = "d52fea3a7dc855bc",
})
