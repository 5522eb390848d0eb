---@meta _
-- The globals of scripts that `lissom test` runs; docs/testing.md tells more.

---Declares a test. It runs after the whole file was loaded, in the order of the file.
---@class lissom.Test
---@overload fun(name: string, body: fun(), options?: lissom.TestOptions)
test = {}

---@class lissom.TestOptions
---@field timeout? number Seconds that the test may take. Default: that of the command line, 60.

---Declares a group: its tests are called "group / test".
---@param name string The name of the group.
---@param body fun() Declares the tests of the group, and groups in it; called at once.
function test.group(name, body) end

---Calls a function before each test of the group, or of the file.
---@param action fun() What is called.
function test.before(action) end

---Calls a function after each test of the group, or of the file, also after one that failed.
---@param action fun() What is called.
function test.after(action) end

---Ends the test, which counts as skipped; outside of tests, the whole file.
---@param reason string Why, for the report.
function test.skip(reason) end

---The folder of the running test, for the files that it writes. It is removed after the test, but kept when the test failed.
---@return string folder # An absolute path.
function test.folder() end

---A file in the folder of the running test.
---@param name string The name of the file.
---@return string path # An absolute path.
function test.file(name) end

---What tests expect. An expectation that does not hold is an error at the line that calls it.
---@class lissom.Expect
expect = {}

---Both are equal: numbers, texts and objects by `==`, tables by their content.
---@param got any What the test got.
---@param wanted any What it should be.
function expect.equal(got, wanted) end

---Both are numbers that are near to each other, or tables or buffers of such numbers.
---@param got any What the test got.
---@param wanted any What it should be.
---@param tolerance? number The greatest distance allowed. Default: 1e-9.
function expect.near(got, wanted, tolerance) end

---The value is neither false nor nil.
---@generic T
---@param value? T What the test got.
---@return T value # The same.
function expect.truthy(value) end

---The value is false or nil.
---@param value any What the test got.
function expect.falsy(value) end

---The function raises an error.
---@param action fun() What is called.
---@param text? string Part of its place, message and code.
---@return any error # What was raised.
function expect.error(action, text) end

---A function raises an error object with this code: `expect.failure("file_not_found", lissom.load, "none.obj")`.
---@param code string The code.
---@param action fun(...): ... What is called;
---@param ... any its arguments.
---@return lissom.Error error # What was raised.
function expect.failure(code, action, ...) end

---An object has this hash.
---@param object any An object with a method `hash`.
---@param wanted string The hash.
function expect.hash(object, wanted) end

---@class lissom.PictureTolerance
---@field tolerance? number How far a colour may lie outside of those around its pixel in the other picture, 0 to 1. Default: 0.05.
---@field pixels? number The part of the pixels that may lie further, 0 to 1. Default: 0.0005.

---A picture is the same as a golden one, up to what drivers draw differently. `lissom test --update` writes golden pictures that are missing or differ. Where nothing can be drawn the picture is left out, and the report says so.
---@param picture string|lissom.RenderOptions A .png file, or the options of lissom.render without `file`.
---@param golden string The golden .png file, beside the test file.
---@param options? lissom.PictureTolerance
function expect.picture(picture, golden, options) end
