-- What was done with tools, as calls.
local lissom = require "lissom"

-- The numbers that "1-3 7" stands for.
local function ids(text)
    local list = {}
    for first, last in text:gmatch("(%d+)%-?(%d*)") do
        for i = tonumber(first), tonumber(last) or tonumber(first) do table.insert(list, i) end
    end
    return list
end

local scene = assert(dofile("cactus.lua"))
scene:step("select", function()
    local cactus = scene:get("cactus")
    cactus:set_region("selected", cactus:region{ vertices = ids"1758 1763 1765-1768 1807-1808 1810-1814 1855-1856 1858-1863 1903-1904 1906-1911 1952 1954-1959 2002-2007 2051-2052 2054" })
    local region = cactus:region{ vertices = ids"1758 1763 1765-1768 1807-1808 1810-1814 1855-1856 1858-1863 1903-1904 1906-1911 1952 1954-1959 2002-2007 2051-2052 2054" }:union(cactus:region{ vertices = ids"1758 1763 1765-1768 1807-1808 1810-1814 1855-1856 1858-1863 1903-1904 1906-1911 1952 1954-1959 2002-2007 2051-2052 2054" })
    local region2 = region:union(cactus:region{ vertices = ids"1758 1763 1765-1769 1807-1808 1810-1816 1855-1856 1858-1864 1903-1904 1906-1913 1952 1954-1960 2002-2008 2051-2052 2054-2055" })
    local region3 = region2:union(cactus:region{ vertices = ids"1727 1765-1770 1808 1810-1817 1856 1858-1865 1904 1906-1913 1954-1961 2003-2008 2054-2055" })
    local region4 = region3:union(cactus:region{ vertices = ids"1727 1767-1772 1810-1818 1858-1866 1906-1914 1955-1962 2004-2009 2055" })
    local region5 = region4:union(cactus:region{ vertices = ids"1727 1767-1773 1812-1818 1860-1867 1908-1916 1956-1963 2005-2010 2055" })
    local region6 = region5:union(cactus:region{ vertices = ids"1768-1773 1813-1819 1861-1869 1909-1917 1957-1965 2007-2011" })
    local region7 = region6:union(cactus:region{ vertices = ids"1770-1773 1813-1821 1861-1870 1909-1918 1958-1965 2007-2012" })
    local region8 = region7:union(cactus:region{ vertices = ids"1771-1775 1815-1824 1862-1871 1910-1918 1959-1966 2008-2013" })
    local region9 = region8:union(cactus:region{ vertices = ids"1772-1779 1816-1827 1863-1872 1874 1911-1919 1960-1966 2009-2014 4776-4782" })
    cactus:set_region("selected", region9)
end)
scene:step("select", function()
    local cactus = scene:get("cactus")
    local region = cactus:region("selected")
    local region2 = region:union(cactus:region{ vertices = ids"5620 5650-5656 5680-5688 5712-5720 5745-5752 5778-5784 5812-5813" })
    cactus:set_region("selected", region2)
    local region3 = cactus:region{ vertices = ids"5620 5650-5656 5680-5688 5712-5720 5745-5752 5778-5784 5812-5813" }:union(cactus:region{ vertices = ids"5620 5650-5656 5680-5688 5712-5720 5745-5752 5778-5784 5812-5813" })
    local region4 = region3:union(cactus:region{ vertices = ids"5588-5590 5592 5619-5624 5648-5657 5680-5689 5712-5720 5745-5752 5778-5784 5812-5813" })
    local region5 = region4:union(cactus:region{ vertices = ids"5555-5560 5586-5593 5618-5625 5648-5657 5681-5689 5714-5720 5747-5751" })
    local region6 = region5:union(cactus:region{ vertices = ids"5492-5496 5523-5529 5555-5561 5586-5593 5618-5625 5650-5657 5683-5688 5717-5718" })
    local region7 = region6:union(cactus:region{ vertices = ids"5460-5465 5491-5497 5501 5523-5531 5555-5561 5586-5593 5619-5625 5651-5656" })
    local region8 = region:union(region7)
    cactus:set_region("selected", region8)
end)
scene:step("select", function()
    local cactus = scene:get("cactus")
    local region = cactus:region("selected")
    local region2 = region:grow(1)
    cactus:set_region("selected", region2)
end)
scene:step("select", function()
    local cactus = scene:get("cactus")
    local region = cactus:region("selected")
    local region2 = region:grow(1)
    cactus:set_region("selected", region2)
end)
scene:step("select", function()
    local cactus = scene:get("cactus")
    local region = cactus:region("selected")
    local region2 = region:invert()
    cactus:set_region("selected", region2)
end)
scene:undo()
assert(scene:hash() == "6e393bf66b5a279a")
return scene
