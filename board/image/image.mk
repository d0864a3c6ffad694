# SPDX-License-Identifier: Apache-2.0
# Images of cards, the updates of boards that have one, and cards; part of the Makefile.

PARTS := $(BUILD)/image
of_images = $(addprefix board/image/,$(1))

# Which files count for what. Pages are in the same folders, and are of nothing.
BOARD_FILES := $(shell find board/$(BOARD) -type f ! -name '*.md' ! -name '*.png')
BOOT_FILES  := $(call of_images,boot.sh $(notdir $(wildcard board/image/boot_$(BOARD).sh board/image/device_tree_$(BOARD).sh))) board/debian.sh \
               $(if $(BOOT),$(shell find '$(BOOT)' -type f))
ROOT_FILES  := $(call of_images,root.sh root_without modules enabled_units update_files.sh update_agent.sh system.conf \
               fw_env.config) LICENSE $(shell find board/image/tree -type f) $(filter-out %.md %.yaml,$(wildcard board/service/*))
SLOT_FILES  := $(call of_images,slot.sh fat.sh init.sh cmdline) board/initramfs.sh
CARD_FILES  := $(call of_images,image.sh fat.sh boot_script.sh boot.cmd) board/service/wallwarp.yaml

# What is in them has the time of the newest commit, so that the same tree gives the same bytes.
EPOCH       := echo $${SOURCE_DATE_EPOCH-$$(git log -1 --format=%ct 2>/dev/null || stat -c %Y firmware/version.h)}
IMAGE_EPOCH  = SOURCE_DATE_EPOCH=$$($(EPOCH))

# What bundles are signed with, and what boards check them with. Your own: make signing-key DIR=... A bundle brings with it
# what the next one is checked with.
DEVELOPMENT_KEY := build/development-key
SIGNING_KEY     := $(DEVELOPMENT_KEY)/signing.key
SIGNING_CERT    := $(DEVELOPMENT_KEY)/signing.pem
CA              := $(dir $(SIGNING_CERT))ca.pem
DIR             :=

.PHONY: image
image: setup-image ## Make the image of a board's card, packed for make flash: make BOARD=rpi4 image
	$(Q)$(MAKE) $(SUB) programs $(BUILD)/wallwarp-$(BOARD).img.xz $(BUILD)/wallwarp-$(BOARD).spdx
build/image.made: board/image/debian.sh board/debian.sh
	$(if $(V),,@echo "  DEBIAN build/image")
	$(Q)board/image/debian.sh build/image
	$(Q)touch $@
$(PARTS)/boot.made: build/image.made $(BOOT_FILES) $(BOARD_FILES)
	$(if $(V),,@echo "  BOOT  $(PARTS)/boot")
	$(Q)board/image/boot.sh $(BOARD) build/image $(PARTS)
	$(Q)touch $@
$(PARTS)/root.squashfs: $(PARTS)/boot.made $(ROOT_FILES) $(PROGRAMS:%=$(BUILD)/%) $(PARTS)/ca.pem $(PARTS)/version
	$(if $(V),,@echo "  ROOT  $@")
	$(Q)$(IMAGE_EPOCH) board/image/root.sh $(BOARD) build/image $(PARTS)/ca.pem "$$(cat $(PARTS)/version)" $(PARTS)
$(PARTS)/kernel.vfat: $(PARTS)/boot.made $(SLOT_FILES) build/info/$(BOARD) $(PARTS)/version
	$(if $(V),,@echo "  SLOT  $@")
	$(Q)$(IMAGE_EPOCH) board/image/slot.sh $(BOARD) build/image $(PARTS)
$(BUILD)/wallwarp-$(BOARD).img: $(PARTS)/root.squashfs $(PARTS)/kernel.vfat $(CARD_FILES)
	$(if $(V),,@echo "  IMAGE $@")
	$(Q)$(IMAGE_EPOCH) board/image/image.sh $(BOARD) $(PARTS) $@
$(BUILD)/wallwarp-$(BOARD).img.xz: $(BUILD)/wallwarp-$(BOARD).img board/image/pack.sh
	$(if $(V),,@echo "  XZ    $@")
	$(Q)board/image/pack.sh $<
$(BUILD)/wallwarp-$(BOARD).spdx: $(PARTS)/boot.made $(PARTS)/version $(call of_images,licences.sh licences.awk)
	$(if $(V),,@echo "  SPDX  $@")
	$(Q)board/image/licences.sh $(BOARD) build/image $(PARTS) "$$(date -u -d "@$$($(EPOCH))" +%Y-%m-%dT%H:%M:%SZ)" >$@
# Another certificate is another image, whichever file is newer.
$(PARTS)/ca.pem: $(CA) FORCE
	@mkdir -p $(@D)
	@cmp -s $< $@ || cp $< $@
$(PARTS)/version: FORCE
	@mkdir -p $(@D)
	@board/image/version.sh | cmp -s - $@ || board/image/version.sh >$@
.PHONY: FORCE

.PHONY: bundle signing-key
bundle: setup-image ## Make a signed update: make BOARD=rpi4 SIGNING_KEY=signing.key SIGNING_CERT=signing.pem bundle
	$(Q)$(MAKE) $(SUB) programs $(BUILD)/wallwarp-$(BOARD).raucb
$(BUILD)/wallwarp-$(BOARD).raucb: $(PARTS)/root.squashfs $(PARTS)/kernel.vfat $(SIGNING_KEY) $(SIGNING_CERT) board/image/bundle.sh
	$(Q)board/image/bundle.sh $(BOARD) $(PARTS) $(SIGNING_CERT) $(SIGNING_KEY) $@
	$(if $(filter $(DEVELOPMENT_KEY)/%,$(SIGNING_KEY)),@echo "signed with the development key of build/; for the boards of others make your own: make signing-key")
signing-key: ## Make the key that your boards' updates are signed with: make DIR=FOLDER signing-key
	$(if $(DIR),,$(error signing-key: say where it is to be kept: make DIR=FOLDER signing-key))
	$(Q)board/image/signing_key.sh "$(DIR)"
$(addprefix $(DEVELOPMENT_KEY)/,signing.key signing.pem ca.pem) &:
	@echo "  KEY   $(DEVELOPMENT_KEY): for trying; for the boards of others make your own: make signing-key"
	$(Q)rm -rf $(DEVELOPMENT_KEY); said=$$(board/image/signing_key.sh $(DEVELOPMENT_KEY) 2>&1) || { echo "$$said" >&2; exit 1; }

# What a card gets is said on the command line: a desktop has a DISPLAY of its own. How: board/image/README.md.
CARD  := DEV IMAGE NODE ROOM KEY CAN DISPLAY CAMERA LOGIN YES
given  = $(foreach n,$(1),$(if $(filter command,$(firstword $(origin $(n)))),'$(n)=$(subst ','\'',$($(n)))'))
.PHONY: flash
flash: setup-flash ## Write a board's card: make BOARD=rpi4 flash DEV=/dev/sdX NODE=3 ROOM=studio.yaml; lists disks without DEV
	$(Q)$(MAKE) -s $(SUB) BOARD=host BUILD=build/host build/host/wallwarp
	$(Q)env -u MAKEFLAGS board/image/flash.sh 'BOARD=$(BOARD)' $(call given,$(CARD))

# The longest first, as they run side by side.
VM_TESTS := $(addprefix tests/board/image/vm_,update.sh cuts.sh data.sh)
VM_TESTS += $(filter-out $(VM_TESTS),$(wildcard tests/board/image/vm_*.sh))
.PHONY: test-image
test-image: setup-test setup-board setup-image ## Boot the image of the virtual board, update it, and cut its power CUTS=2 times; the last line says how many tests passed
	$(Q)$(MAKE) $(SUB) BOARD=qemu-virt image
	$(Q)$(MAKE) $(SUB) programs build/host/tests/board/picture_tool build/host/tests/board/wire_tool
	$(Q)tests/run.sh build/test-image $(foreach t,$(VM_TESTS) $(IMAGE_TESTS),'$(t) build/qemu-virt') \
	    'tests/board/image/on_used_card.sh build/qemu-virt/wallwarp-qemu-virt.img.xz'

# Not of test-image: the Pi's image has firmware that is not free.
.PHONY: test-pi
test-pi: setup-test setup-board setup-image setup-flash ## Look through the image of the Raspberry Pi 4, and start it on QEMU's Pi 3
	$(Q)$(MAKE) $(SUB) BOARD=rpi4 image
	$(Q)$(MAKE) $(SUB) BOARD=host BUILD=build/host build/host/wallwarp
	$(Q)tests/run.sh build/test-pi $(foreach t,pi_card.sh pi_start.sh,'tests/board/image/$(t) build/rpi4')
