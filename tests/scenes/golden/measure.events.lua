-- What was done with tools; lissom run does it again.
return (require("lissom").replay{
    version = 1,
    open = { "cactus.lua" },
    before = "65d4f1bf8be61cfe",
    events = {
        { "look", { eye = { 0, 0, 5 }, fov = 29.999999999999996, size = { 1280, 960 }, target = { 0, 0, 0 }, up = { 0, 1, 0 } }, t = 0 },
        { "tool", "measure", t = 0.001 },
        { "look", { eye = { 2.2885382203499978, 2.4565857608955204, 3.1064418632227175 }, fov = 29.999999999999996, size = { 990, 682 }, target = { 0.060570319819824976, 1.0428003483489667, -0.07542605300486266 }, up = { -0.19617469496901105, 0.9396926207859083, -0.2801664995932355 } }, t = 0.036 },
        { "press", 339, 215, t = 0.863 },
        { "release", 339, 215, t = 0.868 },
        { "press", 605, 150, t = 1.414 },
        { "release", 605, 150, t = 1.415 },
    },
    after = "65d4f1bf8be61cfe",
})
