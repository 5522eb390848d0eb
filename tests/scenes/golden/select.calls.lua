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
    cactus:set_region("selected", cactus:region{ vertices = ids"1717 1758 1762-1763 1765-1767 1803 1807-1808 1810-1813 1851 1855-1856 1858-1862 1903-1904 1906-1910 1951-1952 1954-1959 2000 2002-2006 2050-2052" })
    local region = cactus:region{ vertices = ids"1717 1758 1762-1763 1765-1767 1803 1807-1808 1810-1813 1851 1855-1856 1858-1862 1903-1904 1906-1910 1951-1952 1954-1959 2000 2002-2006 2050-2052" }:union(cactus:region{ vertices = ids"1768 1814 1863 1911 2007 2054" })
    local region2 = region:union(cactus:region{ vertices = ids"1769 1815-1816 1864 1912-1913 1960 2008 2055" })
    local region3 = region2:union(cactus:region{ vertices = ids"1727 1770 1817 1865 1961" })
    local region4 = region3:union(cactus:region{ vertices = ids"1771-1772 1818 1866 1914 1962 2009" })
    local region5 = region4:union(cactus:region{ vertices = ids"1773 1867 1915-1916 1963 2010" })
    local region6 = region5:union(cactus:region{ vertices = ids"1819 1868-1869 1917 1964-1965 2011" })
    local region7 = region6:union(cactus:region{ vertices = ids"1820-1821 1870 1918 2012" })
    local region8 = region7:union(cactus:region{ vertices = ids"1774-1775 1822-1824 1871 1966 2013" })
    local region9 = region8:union(cactus:region{ vertices = ids"1776-1777 1825-1826 1872 1919 2014 4779-4782" })
    local region10 = region9:union(cactus:region{ vertices = ids"1778-1779 1827 1874 4776-4778" })
    cactus:set_region("selected", region10)
end)
scene:step("select", function()
    local cactus = scene:get("cactus")
    local region = cactus:region("selected")
    local region2 = region:union(cactus:region{ vertices = ids"5683-5686 5712-5720 5744-5752 5776-5784 5808-5816 5842-5847 5875-5878" })
    cactus:set_region("selected", region2)
    local region3 = cactus:region{ vertices = ids"5683-5686 5712-5720 5744-5752 5776-5784 5808-5816 5842-5847 5875-5878" }:union(cactus:region{ vertices = ids"5620 5650-5656 5680-5682 5687-5688" })
    local region4 = region3:union(cactus:region{ vertices = ids"5588-5590 5592 5619 5621-5624 5648-5649 5657 5689" })
    local region5 = region4:union(cactus:region{ vertices = ids"5555-5560 5586-5587 5591 5593 5618 5625" })
    local region6 = region5:union(cactus:region{ vertices = ids"5492-5496 5523-5529 5561" })
    local region7 = region6:union(cactus:region{ vertices = ids"5460-5465 5491 5497 5501 5530-5531" })
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
assert(scene:hash() == "cd90fdddba07deb9")
return scene
