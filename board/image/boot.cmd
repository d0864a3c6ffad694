# SPDX-License-Identifier: Apache-2.0
# Chooses the slot that U-Boot starts, and starts it. mkimage makes boot.scr of it; U-Boot's distro boot runs that.
#
# Which slot is next is in partition `state`, in the format of U-Boot's redundant environment, which fw_setenv of
# libubootenv writes too (fw_env.config): two copies, each one sector that a board writes whole or not at all. A copy is
# its CRC, one byte that counts writes, and NAME=VALUE strings. A write goes to the older or broken copy.
#   BOOT_ORDER    slots to try, best first: "A B". One that is being written, or was given up, is not in it
#   BOOT_x_LEFT   starts that are left to slot x. Each start takes one; a slot at 0 is passed over; when none is left,
#                 each slot gets 3 again. The update agent gives 3 to a slot on trial, and 9 after that at every start
#   BOOT_UPDATE   the agent's: "waiting B", "trial B" or "failed B"; nothing when all is settled
# Both copies broken: A, then B.
#
# A slot's kernel partition holds /vmlinuz, /initrd, /cmdline (one line) and, where it is needed, /board.dtb.
# more_arguments, when it was set at U-Boot's prompt, goes to the kernel too. A slot on trial is told so.

part start ${devtype} ${devnum} state block_0
setexpr block_1 ${block_0} + 400
# Memory that the kernel gets later. The sum is made at sum_0; in a copy its most significant byte comes last.
setexpr copy_0 ${kernel_addr_r} + 0
setexpr copy_1 ${kernel_addr_r} + 200
setexpr sum_0 ${kernel_addr_r} + 400
setexpr sum_1 ${kernel_addr_r} + 401
setexpr sum_2 ${kernel_addr_r} + 402
setexpr sum_3 ${kernel_addr_r} + 403
setexpr crc_0 ${kernel_addr_r} + 404
setexpr crc_1 ${kernel_addr_r} + 405
setexpr crc_2 ${kernel_addr_r} + 406
setexpr crc_3 ${kernel_addr_r} + 407
setenv find_crc 'setexpr strings ${copy} + 5; crc32 ${strings} 1fb ${sum_0}; run order_crc'
# Which of its bytes crc32 writes first depends on what U-Boot was built with: the sum of four zeros tells.
mw.l ${copy_0} 0
crc32 ${copy_0} 4 ${sum_0}
if itest.l *${sum_0} == 2144df1c; then
    setenv order_crc 'cp.b ${sum_0} ${crc_0} 4'
else
    setenv order_crc 'cp.b ${sum_3} ${crc_0} 1; cp.b ${sum_2} ${crc_1} 1; cp.b ${sum_1} ${crc_2} 1; cp.b ${sum_0} ${crc_3} 1'
fi

setenv whole_0 no
setenv whole_1 no
setenv count_0 0
setenv count_1 0
setenv copy ${copy_0}
if ${devtype} read ${copy} ${block_0} 1; then
    run find_crc
    if itest.l *${copy} == *${crc_0}; then setenv whole_0 yes; fi
    setexpr byte ${copy} + 4
    setexpr.b count_0 *${byte}
fi
setenv copy ${copy_1}
if ${devtype} read ${copy} ${block_1} 1; then
    run find_crc
    if itest.l *${copy} == *${crc_0}; then setenv whole_1 yes; fi
    setexpr byte ${copy} + 4
    setexpr.b count_1 *${byte}
fi

# The newer copy, as libubootenv decides it; the count starts again after ff.
setenv newer 0
if itest ${count_1} > ${count_0}; then setenv newer 1; fi
if itest ${count_0} == ff && itest ${count_1} == 0; then setenv newer 1; fi
if itest ${count_1} == ff && itest ${count_0} == 0; then setenv newer 0; fi
if test ${whole_1} = no; then setenv newer 0; fi
if test ${whole_0} = no; then setenv newer 1; fi

setenv BOOT_ORDER A B
setenv BOOT_A_LEFT 3
setenv BOOT_B_LEFT 3
setenv BOOT_UPDATE
if test ${whole_0}${whole_1} = nono; then
    echo "wallwarp: both copies of the boot state are broken, starting with slot A"
elif test ${newer} = 0; then
    setexpr strings ${copy_0} + 5
    env import -b ${strings} 1fb BOOT_ORDER BOOT_A_LEFT BOOT_B_LEFT BOOT_UPDATE
else
    setexpr strings ${copy_1} + 5
    env import -b ${strings} 1fb BOOT_ORDER BOOT_A_LEFT BOOT_B_LEFT BOOT_UPDATE
fi
if test ${newer} = 0; then
    setenv copy ${copy_1}
    setenv block ${block_1}
    setexpr count ${count_0} + 1
else
    setenv copy ${copy_0}
    setenv block ${block_0}
    setexpr count ${count_1} + 1
fi

setenv slot
for x in ${BOOT_ORDER}; do
    if test -z "${slot}" && test ${x} = A && itest ${BOOT_A_LEFT} > 0; then
        setenv slot A
        setenv letter a
        setexpr BOOT_A_LEFT ${BOOT_A_LEFT} - 1
        setenv left ${BOOT_A_LEFT}
    fi
    if test -z "${slot}" && test ${x} = B && itest ${BOOT_B_LEFT} > 0; then
        setenv slot B
        setenv letter b
        setexpr BOOT_B_LEFT ${BOOT_B_LEFT} - 1
        setenv left ${BOOT_B_LEFT}
    fi
done
if test -z "${slot}"; then
    setenv BOOT_A_LEFT 3
    setenv BOOT_B_LEFT 3
fi

setexpr strings ${copy} + 5
env export -b -s 1fb ${strings} BOOT_ORDER BOOT_A_LEFT BOOT_B_LEFT BOOT_UPDATE
run find_crc
cp.b ${crc_0} ${copy} 4
setexpr byte ${copy} + 4
mw.b ${byte} ${count} 1
${devtype} write ${copy} ${block} 1 || echo "wallwarp: the boot state cannot be written"
if test -z "${slot}"; then
    echo "wallwarp: no slot has a start left, all get 3 again"
    reset
fi

echo "wallwarp: starting slot ${slot}, starts left: ${left}"
if test -n "${fdt_addr}"; then setenv tree ${fdt_addr}; else setenv tree ${fdtcontroladdr}; fi
if part number ${devtype} ${devnum} kernel-${letter} number && load ${devtype} ${devnum}:${number} ${kernel_addr_r} /cmdline; then
    setexpr byte ${kernel_addr_r} + ${filesize}
    mw.b ${byte} 0 1
    setexpr.s cmdline *${kernel_addr_r}
    setenv bootargs "${cmdline} root=PARTLABEL=root-${letter} rauc.slot=${slot} ${more_arguments}"
    if test "${BOOT_UPDATE}" = "trial ${slot}"; then setenv bootargs "${bootargs} wallwarp.trial"; fi
    echo "wallwarp: the kernel gets ${bootargs}"
    if test -e ${devtype} ${devnum}:${number} /board.dtb; then
        setenv tree ${fdt_addr_r}
        load ${devtype} ${devnum}:${number} ${tree} /board.dtb || setenv tree
    fi
    if test -n "${tree}" && load ${devtype} ${devnum}:${number} ${kernel_addr_r} /vmlinuz && load ${devtype} ${devnum}:${number} ${ramdisk_addr_r} /initrd; then
        booti ${kernel_addr_r} ${ramdisk_addr_r}:${filesize} ${tree}
    fi
fi
echo "wallwarp: slot ${slot} cannot be started"
reset
