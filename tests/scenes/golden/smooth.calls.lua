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
scene:step("smooth", function()
    local cactus = scene:get("cactus")
    cactus:smooth{ boundary = "fixed", iterations = 2, keep_volume = false, region = cactus:region{ vertices = ids"2818-2822 2864 2866-2871 2912 2914-2920 2960 2962-2968 3010-3016 3060-3063" }, strength = 0.3 }
    cactus:smooth{ boundary = "fixed", iterations = 2, keep_volume = false, region = cactus:region{ vertices = ids"2434-2437 2480 2482-2487 2528 2530-2536 2576 2578-2584 2624 2626-2632 2672 2674-2680 2720 2722-2728 2768 2770-2776 2816 2818-2824 2864 2866-2872 2912 2914-2920 2960 2962-2968 3010-3016 3060-3063" }, strength = 0.3 }
    cactus:smooth{ boundary = "fixed", iterations = 2, keep_volume = false, region = cactus:region{ vertices = ids"2050-2053 2096 2098-2103 2144 2146-2152 2192 2194-2200 2240 2242-2248 2288 2290-2296 2336 2338-2344 2384 2386-2392 2432 2434-2440 2480 2482-2488 2528 2530-2536 2576 2578-2584 2626-2632 2674-2679" }, strength = 0.3 }
    cactus:smooth{ boundary = "fixed", iterations = 2, keep_volume = false, region = cactus:region{ vertices = ids"1677 1681 1683-1687 1721-1722 1724-1729 1763 1765-1770 1807-1808 1810-1816 1856 1858-1864 1903-1904 1906-1912 1952 1954-1960 1999-2000 2002-2008 2048 2050-2056 2095-2096 2098-2104 2144 2146-2152 2192 2194-2200 2240 2242-2248 2290-2295 2340-2342" }, strength = 0.3 }
    cactus:smooth{ boundary = "fixed", iterations = 2, keep_volume = false, region = cactus:region{ vertices = ids"1262 1301-1307 1341-1350 1382-1391 1422-1425 1427-1433 1467 1472-1473 1475-1480 1512-1513 1516-1517 1519-1524 1557-1558 1560-1565 1594-1595 1598-1599 1601-1606 1639-1640 1642-1647 1676-1677 1680-1681 1683-1688 1721-1722 1724-1730 1759 1763 1765-1771 1807-1808 1810-1816 1856 1858-1864 1906-1911 3608" }, strength = 0.3 }
    cactus:smooth{ boundary = "fixed", iterations = 2, keep_volume = false, region = cactus:region{ vertices = ids"797 845 849-850 852 893 897-898 900-904 941 945-946 948-953 993-994 996-1001 1037 1041-1042 1044-1050 1086 1089-1090 1092-1098 1134 1137-1138 1140-1146 1176-1179 1181-1187 1217-1220 1222-1228 1259-1269 1300-1310 1341-1351 1382-1392 1423-1425 1427-1433 1473 1475-1480 1519-1524 1561-1564" }, strength = 0.3 }
    cactus:smooth{ boundary = "fixed", iterations = 2, keep_volume = false, region = cactus:region{ vertices = ids"797-798 845 849-850 852 855 893-894 897-898 900-904 941 945-946 948-955 989 993-994 996-1003 1041-1042 1044-1051 1090 1092-1099 1140-1146 1181-1186" }, strength = 0.3 }
    cactus:smooth{ boundary = "fixed", iterations = 2, keep_volume = false, region = cactus:region{ vertices = ids"852 855 894 898 900-907 942 945-946 948-955 993-994 996-1004 1042 1044-1052 1090 1092-1100 1140-1147 1182-1187" }, strength = 0.3 }
    cactus:smooth{ boundary = "fixed", iterations = 2, keep_volume = false, region = cactus:region{ vertices = ids"855 900-908 948-956 996-1005 1044-1054 1092-1101 1141-1148 1183-1189 1227" }, strength = 0.3 }
    cactus:smooth{ boundary = "fixed", iterations = 2, keep_volume = false, region = cactus:region{ vertices = ids"859 902-909 911 949-959 995-1007 1045-1055 1093-1103 1142-1150 1184-1190" }, strength = 0.3 }
    cactus:smooth{ boundary = "fixed", iterations = 2, keep_volume = false, region = cactus:region{ vertices = ids"904-912 951-960 998-1008 1046-1056 1095-1104 1143-1151 1185-1191" }, strength = 0.3 }
    cactus:smooth{ boundary = "fixed", iterations = 2, keep_volume = false, region = cactus:region{ vertices = ids"906-912 952-960 1000-1008 1048-1056 1096-1104 1144-1152 1185-1193 1225-1234 1267-1275 1308-1316 1349-1355 1357 1390-1396 1398 1431-1438 1479-1485 1523-1528 1565-1569" }, strength = 0.3 }
    cactus:smooth{ boundary = "fixed", iterations = 2, keep_volume = false, region = cactus:region{ vertices = ids"1310-1315 1350-1355 1357 1390-1396 1398 1431-1438 1479-1485 1523-1528 1564-1569 1605-1610 1646-1651 1687-1692 1728-1733 1769-1774 1814-1820 1862-1869 1911-1916 1962 4782-4789" }, strength = 0.3 }
    cactus:smooth{ boundary = "fixed", iterations = 2, keep_volume = false, region = cactus:region{ vertices = ids"1689-1691 1729-1733 1769-1774 1814-1820 1862-1869 1910-1918 1958-1966 2006-2014 2054-2062 2102-2110 2150-2158 2198-2206 2246-2253 2295-2301 2344 2346-2347 4782" }, strength = 0.3 }
    cactus:smooth{ boundary = "fixed", iterations = 2, keep_volume = false, region = cactus:region{ vertices = ids"2057-2061 2103-2110 2150-2158 2198-2206 2246-2254 2294-2302 2342-2350 2390-2398 2438-2446 2486-2494 2534-2542 2582-2590 2631-2637 2679-2685 2730" }, strength = 0.3 }
    cactus:smooth{ boundary = "fixed", iterations = 2, keep_volume = false, region = cactus:region{ vertices = ids"2441-2443 2445 2487-2493 2535-2542 2582-2590 2630-2638 2678-2686 2726-2734 2774-2782 2822-2830 2870-2878 2918-2926 2967-2974 3015-3021 3064-3068" }, strength = 0.3 }
end)
scene:step("smooth", function()
    local cactus = scene:get("cactus")
    cactus:smooth{ boundary = "fixed", iterations = 2, keep_volume = false, region = cactus:region{ vertices = ids"2736 2738 2783 2786-2787 2828-2832 2834-2835 2875-2879 2882-2883 2922-2928 2930-2931 2970-2975 2978-2979 3019-3023 3068-3070" }, strength = 0.3 }
    cactus:smooth{ boundary = "fixed", iterations = 2, keep_volume = false, region = cactus:region{ vertices = ids"2543-2544 2546-2547 2590-2591 2594-2595 2636-2640 2642-2643 2683-2687 2690-2691 2730-2735 2738-2739 2778-2784 2786-2787 2826-2832 2834-2835 2874-2880 2882-2883 2922-2928 2930-2931 2970-2976 2978-2979 3019-3023 3068-3070" }, strength = 0.3 }
    cactus:smooth{ boundary = "fixed", iterations = 2, keep_volume = false, region = cactus:region{ vertices = ids"2351 2354-2355 2397-2399 2402-2403 2443-2448 2450-2451 2491-2495 2498-2499 2538-2544 2546-2547 2586-2592 2594-2595 2634-2640 2642-2643 2682-2688 2690-2691 2730-2736 2738-2739 2778-2784 2786-2787 2827-2831 2877-2878" }, strength = 0.3 }
    cactus:smooth{ boundary = "fixed", iterations = 2, keep_volume = false, region = cactus:region{ vertices = ids"2114-2115 2159 2162-2163 2205-2207 2210-2211 2251-2255 2258-2259 2298-2303 2306-2307 2346-2352 2354-2355 2394-2400 2402-2403 2442-2448 2450-2451 2490-2496 2498-2499 2538-2544 2546-2547 2586-2592 2594 2635-2638 2686" }, strength = 0.3 }
    cactus:smooth{ boundary = "fixed", iterations = 2, keep_volume = false, region = cactus:region{ vertices = ids"1919 1922-1923 1966-1967 1970-1971 2012-2015 2018-2019 2059-2063 2066-2067 2106-2111 2114-2115 2154-2160 2162-2163 2202-2208 2210-2211 2250-2256 2258-2259 2298-2304 2306-2307 2346-2352 2354-2355 2394-2400 2443-2446" }, strength = 0.3 }
    cactus:smooth{ boundary = "fixed", iterations = 2, keep_volume = false, region = cactus:region{ vertices = ids"1775-1779 1819-1827 1866-1872 1874-1875 1914-1920 1922-1923 1962-1968 1970-1971 2010-2016 2018-2019 2058-2064 2066-2067 2106-2112 2114-2115 2154-2160 2162-2163 2203-2208 2251-2254 4775-4781 4809-4812" }, strength = 0.3 }
end)
assert(scene:hash() == "7d6a7a5fcd3fd51a")
return scene
